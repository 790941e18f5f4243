//! The names in a table and those in the library, compared while the program is compiled.

/// The first key of every entry.
const NAME: &str = "\nname = \"";

/// Whether the entries of `table` under `heading` are those of `lists`: each is the next one of a list, the first list that has it
/// next, and none is left over.
pub const fn lists<const LISTS: usize>(table: &str, heading: &str, lists: [&[&str]; LISTS]) -> bool {
    let mut next = [0; LISTS];
    let mut at = 0;
    while at < table.len() {
        if has(table, at, heading) && has(table, at + heading.len(), NAME) {
            let name = at + heading.len() + NAME.len();
            let mut list = 0;
            while list < LISTS && !is_next(table, name, lists[list], next[list]) {
                list += 1;
            }
            if list == LISTS {
                return false;
            }
            next[list] += 1;
        }
        at = next_line(table, at);
    }
    let mut list = 0;
    while list < LISTS && next[list] == lists[list].len() {
        list += 1;
    }
    list == LISTS
}

/// The first elements of all pairs.
pub const fn first<T: Copy, const LENGTH: usize>(pairs: &[(&'static str, T); LENGTH]) -> [&'static str; LENGTH] {
    let mut names = [""; LENGTH];
    let mut place = 0;
    while place < LENGTH {
        names[place] = pairs[place].0;
        place += 1;
    }
    names
}

/// Whether the quoted name in `text` whose first letter is at `at` is the one of `names` at `place`.
const fn is_next(text: &str, at: usize, names: &[&str], place: usize) -> bool {
    place < names.len() && has(text, at, names[place]) && has(text, at + names[place].len(), "\"\n")
}

/// Whether `text` has `part` at `at`.
const fn has(text: &str, at: usize, part: &str) -> bool {
    let (text, part) = (text.as_bytes(), part.as_bytes());
    let mut place = 0;
    while place < part.len() {
        if at + place >= text.len() || text[at + place] != part[place] {
            return false;
        }
        place += 1;
    }
    true
}

/// Where the line after the one with `at` begins.
const fn next_line(text: &str, mut at: usize) -> usize {
    while at < text.len() && text.as_bytes()[at] != b'\n' {
        at += 1;
    }
    at + 1
}
