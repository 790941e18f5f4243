#![cfg(unix)]

use brinell::parts::{ABANDONED, DRAFT, LOCKED, PrivateFolder, draft_in};
use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, SystemTime};

const FOLDER: &str = "brinell-check-";

/// Makes a file or a folder as a killed program leaves it, last changed `age` ago.
fn left(path: &Path, is_folder: bool, age: Duration) {
    if is_folder {
        fs::create_dir(path).unwrap();
        fs::write(path.join("library.so"), "x").unwrap();
    } else {
        fs::write(path, "half").unwrap();
    }
    File::open(path).unwrap().set_modified(SystemTime::now() - age).unwrap();
}

/// Whether the entry `name` is still there after another program has made its file and its folder.
fn stays(name: &str, is_folder: bool, age: Duration, locked: bool) -> bool {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join(name);
    left(&path, is_folder, age);
    let lock = locked.then(|| File::open(&path).unwrap());
    lock.iter().for_each(|lock| lock.lock().unwrap());
    let draft = draft_in(place.path()).unwrap();
    let folder = PrivateFolder::new(FOLDER, place.path()).unwrap();
    assert!(draft.path().exists() && folder.path().exists(), "nobody removes its own");
    path.exists()
}

#[test]
fn what_a_killed_program_left_is_removed_and_what_is_in_use_or_not_ours_stays() {
    let minute = Duration::from_secs(60);
    for (prefix, is_folder) in [(DRAFT, false), (FOLDER, true)] {
        let name = format!("{prefix}a1b2C3d4E5f6.tmp");
        assert!(!stays(&name, is_folder, minute, false), "{name}");
        assert!(stays(&name, is_folder, minute, true), "{name}: somebody writes it");
        assert!(stays(&name, is_folder, 3 * ABANDONED, true), "{name}: somebody has written it for days");
        assert!(stays(&name, is_folder, LOCKED / 2, false), "{name}: it may not have its lock yet");
        // a file for a folder, and the other way round
        assert!(stays(&name, !is_folder, minute, false), "{name}: another kind");
        for other in ["a1b2C3d4E5f6", "a1b2C3d4E5f.tmp", "a1b2C3d4E5f6.tmp.txt", "a1b2-3d4E5f6.tmp", "output", ""] {
            let name = format!("{prefix}{other}");
            assert!(stays(&name, is_folder, 3 * ABANDONED, false), "{name}: the user's own");
        }
    }
}

/// Nothing that a link leads to is removed, nor the link.
#[test]
fn a_link_with_the_name_of_a_temporary_folder_stays_with_its_target() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("results");
    left(&target, true, 3 * ABANDONED);
    let link = place.path().join(format!("{FOLDER}a1b2C3d4E5f6.tmp"));
    std::os::unix::fs::symlink(&target, &link).unwrap();
    drop(PrivateFolder::new(FOLDER, place.path()).unwrap());
    assert!(fs::symlink_metadata(&link).is_ok() && target.join("library.so").exists());
}

/// Programs that run at the same time write to one folder.
#[test]
fn writers_at_the_same_time_do_not_sweep_each_other() {
    let place = tempfile::tempdir().unwrap();
    let write = |number: usize| {
        for turn in 0..50 {
            let goal = place.path().join(format!("{number}-{turn}.csv"));
            brinell::parts::write_whole(&goal, b"whole").unwrap();
            assert_eq!(fs::read(&goal).unwrap(), b"whole");
        }
    };
    std::thread::scope(|scope| (0..4).for_each(|number| drop(scope.spawn(move || write(number)))));
    assert_eq!(fs::read_dir(place.path()).unwrap().count(), 200, "no draft stays");
}
