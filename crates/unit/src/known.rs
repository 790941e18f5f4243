//! The data of a compiled library: constants, so that the compiler leaves out what the scene does not need.

use crate::exported::{Library, WORDS};
use brinell_fmu::scene::library::block::{Contents, Data, Places, pool_of};
use brinell_fmu::scene::library::{LibraryScene, Memory};

/// The scene of this library.
pub type Exported = LibraryScene<Library, Known>;

/// The constants.
pub struct Known;

static DATA: Data = Data::of_words(&WORDS);
static POOL: [u64; WORDS.len() - Data::WORDS] = pool_of(&WORDS);

impl Memory for Known {
    const PLACES: Option<&'static Places> = Some(&const { Data::of_words(&WORDS).places() });

    #[inline(always)]
    fn contents() -> Contents<'static> {
        Contents { data: &DATA, pool: &POOL }
    }

    fn verify() -> Result<(), &'static str> {
        Ok(())
    }
}
