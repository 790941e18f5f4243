//! The FMU: made of the page's own libraries, and read back for its scene.

use crate::Refused;
use crate::text::scene;
use brinell_exporter::package::{join, pack};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::{Platform, System};
use brinell_exporter::prebuilt::PrebuiltUnit;
use brinell_exporter::prebuilt::archive::LibraryList;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::sync::{Mutex, PoisonError};

/// A list of libraries, and their archive.
type Store = (LibraryList, Vec<u8>);

/// The libraries that the page has given, by their target.
static STORES: Mutex<BTreeMap<String, Store>> = Mutex::new(BTreeMap::new());

/// Libraries for a target.
#[derive(Deserialize)]
pub struct Given {
    triple: String,
    /// Length of the list, behind which the archive begins \[bytes\].
    list: usize,
}

/// Takes the libraries for a target.
pub fn libraries(given: &Given, bytes: &[u8]) -> Result<Value, Refused> {
    let (list, archive) = bytes.split_at_checked(given.list).ok_or("the list is longer than all bytes")?;
    let list = LibraryList::read(std::str::from_utf8(list)?)?;
    let mut stores = STORES.lock().unwrap_or_else(PoisonError::into_inner);
    stores.insert(given.triple.clone(), (list, archive.into()));
    Ok(json!({}))
}

/// An export for these folders of an FMU.
#[derive(Deserialize)]
pub struct Export {
    text: String,
    platforms: Vec<String>,
}

/// The bytes of the FMU, as `brinell export --prebuilt` writes them.
pub fn export(asked: &Export) -> Result<(Value, Vec<u8>), Refused> {
    let (scene, _) = scene(&asked.text)?;
    let known = || Platform::ALL.into_iter().chain([Platform::C_CODE]);
    let platforms = asked.platforms.iter().map(|folder| {
        let found = known().find(|platform| platform.folder == folder);
        found.ok_or_else(|| format!("there is no platform `{folder}`"))
    });
    let platforms = platforms.collect::<Result<Vec<_>, _>>()?;
    if platforms.is_empty() {
        return Err("an FMU needs at least one platform".into());
    }
    let stores = STORES.lock().unwrap_or_else(PoisonError::into_inner);
    let store = |triple: &str| stores.get(triple).ok_or_else(|| format!("this page has no libraries for {triple}"));
    let plan = Plan::of(&scene);
    let first = store(platforms[0].targets[0].triple)?;
    let unit = PrebuiltUnit::of(&plan, &first.0.sources)?;
    let slice = |target: &brinell_exporter::platform::Target| -> Result<Vec<u8>, Refused> {
        let (list, archive) = store(target.triple)?;
        let mut library = list.library(archive, &unit.library)?;
        if target.system == System::WebAssembly {
            return Ok(unit.fill_source(&library)?);
        }
        unit.fill(&mut library)?;
        Ok(library)
    };
    let library = |platform: &Platform| {
        let slices = platform.targets.iter().map(slice).collect::<Result<Vec<_>, _>>()?;
        Ok::<_, Refused>(join(&slices.iter().map(Vec::as_slice).collect::<Vec<_>>()))
    };
    let libraries = platforms.iter().map(library).collect::<Result<Vec<_>, _>>()?;
    let (archive, _) = pack(&plan, &unit.guid, &platforms, &libraries)?;
    let variables: Vec<_> = plan.variables.iter().map(|entry| entry.name(0)).collect();
    let said = json!({
        "name": format!("{}.fmu", scene.name), "guid": unit.guid, "library": unit.library.name, "variables": variables,
    });
    Ok((said, archive))
}

/// The largest scene of an FMU that is read \[bytes\].
const LARGEST: u64 = 16 << 20;

/// The text of the scene in an FMU.
pub fn scene_of(bytes: &[u8]) -> Result<Value, Refused> {
    const PLACE: &str = "resources/scene.toml";
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|error| format!("this is no FMU: {error}"))?;
    let file = archive.by_name(PLACE).map_err(|_| format!("this FMU is not of Brinell: it has no {PLACE}"))?;
    let too_large = || format!("{PLACE} in it has more than {LARGEST} bytes, which no scene of this page needs");
    if file.size() > LARGEST {
        return Err(too_large().into());
    }
    let mut bytes = Vec::new();
    file.take(LARGEST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST {
        return Err(too_large().into());
    }
    let text = String::from_utf8(bytes).map_err(|_| format!("{PLACE} in it is no text in UTF-8"))?;
    Ok(json!({ "text": text }))
}
