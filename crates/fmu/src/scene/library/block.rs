//! The data of a scene: [`Data`], whose lists lie in a pool of words.
//!
//! In a prebuilt library both are a [`Block`] of memory, which the exporter fills in and the library only reads. A compiled library has
//! them as constants, [made](Data::of_words) from the same words. All numbers are 64-bit words, little-endian as on every supported
//! platform.

use crate::c::words::{bytes_of, numbers_of};
use crate::scene::Parameter;
use crate::scene::variable::Source;
use brinell_contact::LawNumbers;
use brinell_contact::rate::Rate;
use core::ops::Deref;

/// First word of every block ("brinell" and a zero).
pub const MAGIC: u64 = u64::from_le_bytes(*b"brinell\0");

/// Version of the layout.
pub const VERSION: u64 = 10;

/// Capacity for kinds of variables of a contact.
pub const KINDS: usize = 64;

/// Capacity for the [lists](List) \[words\].
pub const POOL: usize = 16_384;

/// The first code of a kind of variable that denotes an Integer. The codes follow the order of [`Real`](crate::scene::Real), then
/// of [`Integer`](crate::scene::Integer).
pub const FIRST_INTEGER: u8 = 128;

/// The code of no kind.
pub const NO_KIND: u8 = u8::MAX;

/// The kind of variable of each code; [`NO_KIND`] of a code that no variable has.
pub type Places = [u8; NO_KIND as usize + 1];

/// The block: a header, and the data.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Block {
    /// [`MAGIC`].
    pub magic: u64,
    /// [`VERSION`].
    pub version: u64,
    /// Identifies the library that the data are for.
    pub library: u64,
    /// Length of the data up to the last list \[words\]; zero in a block that has not been filled in. Nothing reads what is behind.
    pub length: u64,
    /// Hash of as many words.
    pub checksum: u64,
    /// The scene.
    pub data: Data,
    /// The words of all its lists.
    pub pool: [u64; POOL],
}

/// The data that differ between the scenes of one library.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Data {
    /// A number that identifies the scene; no other scene has it.
    pub identity: u64,
    /// The [flags](Flag) of the scene.
    pub flags: u64,
    /// Number of contacts.
    pub contacts: u64,
    /// Number of groups of equal contacts.
    pub groups: u64,
    /// Number of values of parameters that can be set.
    pub values: u64,
    /// Number of kinds of variables of a contact.
    pub kinds: u64,
    /// Effective mass of the scene's impact \[kg\] if the step size is to be checked, otherwise 0: C compares NaN with a trap.
    pub impact_mass: f64,
    /// The loading law, or the rate-dependent law.
    pub loading: LawNumbers,
    /// The unloading law.
    pub unloading: LawNumbers,
    /// The [loss](Loss) below yield.
    pub loss: u64,
    /// The strain rate of the target, and of the impactor.
    pub rates: [RateNumbers; 2],
    /// Where the value of each parameter comes from, or its [column](source_of_column) where tables differ.
    pub sources: [[u64; SOURCE_WORDS]; Parameter::ALL.len()],
    /// The kind of variable that each kind of value reference denotes.
    pub codes: [u8; KINDS],
    /// The words of each [`List`]: where they begin, and how many there are.
    pub lists: [[u32; 2]; List::COUNT],
}

/// The data of a scene with their lists.
#[derive(Clone, Copy)]
pub struct Contents<'a> {
    /// The data.
    pub data: &'a Data,
    /// The words of all lists.
    pub pool: &'a [u64],
}

impl Deref for Contents<'_> {
    type Target = Data;

    #[inline(always)]
    fn deref(&self) -> &Data {
        self.data
    }
}

/// A list of words in the pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum List {
    /// A row for each [`Table`].
    Tables = 0,
    /// A row for each [`Run`] of values.
    Runs = 1,
    /// A row for each table with a source in each column: those of the parameters whose sources differ between tables.
    Sources = 2,
    /// The inverse masses \[1/kg\].
    InverseMasses = 3,
    /// Where the passivity guard acts, in UTF-8 with zeros at the end.
    Guard = 4,
    /// Texts in UTF-8.
    Texts = 5,
    /// The GUID, in UTF-8.
    Guid = 6,
    /// The numbers of a loading curve of one's own.
    Curve = 7,
}

impl List {
    /// The number of lists.
    pub const COUNT: usize = 8;
}

/// A table of the scene: contacts with the same properties.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// The contact after the last one.
    pub end: u64,
    /// Whether its contacts are counted.
    pub is_counted: bool,
    /// Whether a new contact meets a fresh surface.
    pub is_fresh: bool,
    /// Density of the target \[kg/m^3\]; NaN if unknown.
    pub density: f64,
    /// Contact radius \[m\] that counts as the size of the bodies, where their radii are not those of their numbers; otherwise infinite.
    pub size: f64,
    /// Its name.
    pub name: Text,
}

impl Table {
    /// Words of a row.
    pub const WORDS: usize = 6;

    /// As words.
    pub fn words(&self) -> [u64; Table::WORDS] {
        let flags = [self.is_counted, self.is_fresh].map(u64::from);
        [self.end, flags[0], flags[1], self.density.to_bits(), self.size.to_bits(), self.name.word()]
    }

    /// The table with these words.
    #[inline(always)]
    fn of(&[end, is_counted, is_fresh, density, size, name]: &[u64; Table::WORDS]) -> Table {
        Table {
            end,
            is_counted: is_counted != 0,
            is_fresh: is_fresh != 0,
            density: f64::from_bits(density),
            size: f64::from_bits(size),
            name: Text::of(name),
        }
    }
}

/// Consecutive values of one settable parameter.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The index after the last value.
    pub end: u64,
    /// The contact of the first value, if each contact has its own, and there are several; otherwise `u64::MAX`.
    pub first_contact: u64,
    /// Whether it may be set between steps.
    pub is_tunable: bool,
    /// Start value.
    pub start: f64,
    /// Smallest value allowed.
    pub minimum: f64,
    /// Largest value allowed.
    pub maximum: f64,
    /// Name of the variable.
    pub name: Text,
    /// Unit; empty if there is none.
    pub unit: Text,
}

impl Run {
    /// Words of a row.
    pub const WORDS: usize = 8;

    /// As words.
    pub fn words(&self) -> [u64; Run::WORDS] {
        let numbers = [self.start, self.minimum, self.maximum].map(f64::to_bits);
        let [start, minimum, maximum] = numbers;
        let (name, unit) = (self.name.word(), self.unit.word());
        [self.end, self.first_contact, self.is_tunable.into(), start, minimum, maximum, name, unit]
    }

    /// The run with these words.
    #[inline(always)]
    fn of(&[end, first_contact, is_tunable, start, minimum, maximum, name, unit]: &[u64; Run::WORDS]) -> Run {
        let [start, minimum, maximum] = [start, minimum, maximum].map(f64::from_bits);
        let (name, unit) = (Text::of(name), Text::of(unit));
        Run { end, first_contact, is_tunable: is_tunable != 0, start, minimum, maximum, name, unit }
    }
}

/// Words of a source of a parameter.
pub const SOURCE_WORDS: usize = 2;

/// A source of a parameter as words.
pub fn source_words(source: &Source) -> [u64; SOURCE_WORDS] {
    match *source {
        Source::Constant(value) => [0, value.to_bits()],
        Source::Settable(index) => [1, index as u64],
        Source::PerContact(index) => [2, index as i64 as u64],
    }
}

/// In place of a source: the tables differ, and each has its own in this column.
pub const fn source_of_column(column: usize) -> [u64; SOURCE_WORDS] {
    [3, column as u64]
}

/// A part of [`List::Texts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Text {
    /// First byte.
    pub start: u32,
    /// Number of bytes.
    pub length: u32,
}

impl Text {
    fn word(self) -> u64 {
        u64::from(self.start) << 32 | u64::from(self.length)
    }

    #[inline(always)]
    fn of(word: u64) -> Text {
        Text { start: (word >> 32) as u32, length: word as u32 }
    }
}

/// A model of the strain rate as numbers.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct RateNumbers {
    /// 0 for Johnson and Cook, 1 for Cowper and Symonds.
    pub form: u64,
    /// Its two constants.
    pub constants: [f64; 2],
}

impl RateNumbers {
    /// The numbers of this model.
    pub const fn of(rate: Rate) -> RateNumbers {
        match rate {
            Rate::JohnsonCook { c, reference_rate } => RateNumbers { form: 0, constants: [c, reference_rate] },
            Rate::CowperSymonds { d, q } => RateNumbers { form: 1, constants: [d, q] },
        }
    }

    /// The model with these numbers.
    #[inline(always)]
    pub fn rate(&self) -> Rate {
        let [first, second] = self.constants;
        match self.form {
            0 => Rate::JohnsonCook { c: first, reference_rate: second },
            _ => Rate::CowperSymonds { d: first, q: second },
        }
    }
}

/// A loss below yield.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Loss {
    /// [`RestitutionFitted`](brinell_contact::losses::RestitutionFitted).
    Fitted = 0,
    /// [`HalfSpaceRadiation`](brinell_contact::losses::HalfSpaceRadiation).
    Waves = 1,
    /// [`Plate`](brinell_contact::losses::Plate).
    Plate = 2,
    /// [`Damper`](brinell_contact::losses::Damper), of a rate-dependent law.
    Damper = 3,
}

/// A feature of a scene, as a bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Flag {
    /// Accelerations by all forces except those of the contacts are inputs.
    Acceleration = 0,
    /// The effective mass is an input.
    Mass = 1,
    /// The FMU moves the bodies.
    Moves = 2,
    /// For an importer that steps all FMUs at once.
    Parallel = 3,
    /// Contacts share bodies.
    Shared = 4,
    /// Their inverse masses are inputs.
    InverseMassInputs = 5,
    /// An output needs the momentum of a step.
    Momentum = 6,
    /// The input may have derivatives.
    InputDerivatives = 7,
    /// Forces are stored.
    Forces = 8,
    /// The laws take each of two bodies for itself.
    Paired = 9,
    /// The force depends on the rate.
    FollowsRate = 10,
    /// An output predicts the force of the next step.
    Predicts = 11,
}

impl Flag {
    /// The bit.
    pub const fn bit(self) -> u64 {
        1 << self as u8
    }
}

impl Block {
    /// Length of a block \[words\].
    pub const WORDS: usize = size_of::<Block>() / 8;

    /// The block of a library that has not been filled in.
    pub const fn unfilled(library: u64) -> Block {
        Block { magic: MAGIC, version: VERSION, library, length: 0, checksum: 0, data: Data::EMPTY, pool: [0; POOL] }
    }

    /// Its data and their lists.
    #[inline(always)]
    pub fn contents(&self) -> Contents<'_> {
        Contents { data: &self.data, pool: &self.pool }
    }

    /// Checks that the block, which consists of these `words`, is intact and for this `library`.
    ///
    /// # Errors
    /// A description of the defect.
    pub fn check(&self, words: &[u64; Block::WORDS], library: u64) -> Result<(), &'static str> {
        if self.magic != MAGIC || self.version != VERSION {
            Err("the data of this prebuilt library have another version")
        } else if self.length == 0 {
            Err("this prebuilt library has no scene: `brinell export` puts one in")
        } else if self.library != library {
            Err("the data of this prebuilt library were made for another library")
        } else if self.length != self.data.used() as u64
            || self.checksum != checksum(words.iter().skip(HEAD).take(self.data.used()).copied())
        {
            Err("the data of this prebuilt library are damaged")
        } else {
            Ok(())
        }
    }

    /// A block with these `data` and their lists for a `library`; `None` if there is no room for the lists.
    pub fn filled(library: u64, data: Data, lists: &[u64]) -> Option<Block> {
        let used = data.used();
        let mut block = Block { length: used as u64, data, ..Block::unfilled(library) };
        block.pool.get_mut(..lists.len())?.copy_from_slice(lists);
        block.checksum = checksum(data.words().chain(block.pool).take(used));
        Some(block)
    }

    /// Its words up to the last list.
    pub fn used_words(&self) -> impl Iterator<Item = u64> {
        self.words().take(HEAD + self.data.used())
    }

    /// The words of the block as they lie in memory.
    pub fn words(&self) -> impl Iterator<Item = u64> {
        [self.magic, self.version, self.library, self.length, self.checksum]
            .into_iter()
            .chain(self.data.words())
            .chain(self.pool)
    }
}

impl Data {
    /// The words of the data as they lie in memory.
    pub fn words(&self) -> impl Iterator<Item = u64> {
        let Data { identity, flags, contacts, groups, values, kinds, .. } = *self;
        let law = |law: LawNumbers| core::iter::once(law.law).chain(law.constants.map(f64::to_bits));
        let rate = |rate: RateNumbers| core::iter::once(rate.form).chain(rate.constants.map(f64::to_bits));
        let (codes, _) = self.codes.as_chunks();
        let codes = codes.iter().map(|bytes| u64::from_le_bytes(*bytes));
        let lists = self.lists.map(|[start, length]| u64::from(start) | u64::from(length) << 32);
        [identity, flags, contacts, groups, values, kinds, self.impact_mass.to_bits()]
            .into_iter()
            .chain(law(self.loading))
            .chain(law(self.unloading))
            .chain([self.loss])
            .chain(self.rates.into_iter().flat_map(rate))
            .chain(self.sources.into_iter().flatten())
            .chain(codes)
            .chain(lists)
    }

    /// Length of the data \[words\].
    pub const WORDS: usize = size_of::<Data>() / 8;

    /// Length of the data up to the last list \[words\].
    fn used(&self) -> usize {
        let ends = self.lists.iter().map(|&[start, length]| (start as usize).wrapping_add(length as usize));
        Data::WORDS.wrapping_add(ends.max().unwrap_or(0))
    }

    /// The data of no scene.
    pub const EMPTY: Data = Data {
        identity: 0,
        flags: 0,
        contacts: 0,
        groups: 0,
        values: 0,
        kinds: 0,
        impact_mass: 0.0,
        loading: LawNumbers::NONE,
        unloading: LawNumbers::NONE,
        loss: 0,
        rates: [RateNumbers::of(Rate::NONE); 2],
        sources: [[0; SOURCE_WORDS]; Parameter::ALL.len()],
        codes: [NO_KIND; KINDS],
        lists: [[0; 2]; List::COUNT],
    };

    /// The data with these [words](Data::words), for a library that is compiled with them.
    pub const fn of_words(words: &[u64]) -> Data {
        let mut words = Words { words, next: 0 };
        let mut data = Data::EMPTY;
        data.identity = words.take();
        data.flags = words.take();
        data.contacts = words.take();
        data.groups = words.take();
        data.values = words.take();
        data.kinds = words.take();
        data.impact_mass = words.number();
        data.loading = words.law();
        data.unloading = words.law();
        data.loss = words.take();
        data.rates = [words.rate(), words.rate()];
        let mut parameter = 0;
        while parameter < data.sources.len() {
            data.sources[parameter] = [words.take(), words.take()];
            parameter += 1;
        }
        data.codes = words.bytes();
        let mut list = 0;
        while list < List::COUNT {
            let word = words.take();
            data.lists[list] = [word as u32, (word >> 32) as u32];
            list += 1;
        }
        data
    }

    /// The kind of variable of each code.
    pub const fn places(&self) -> Places {
        let mut places = [NO_KIND; NO_KIND as usize + 1];
        let mut kind = 0;
        while kind < self.kinds as usize {
            places[self.codes[kind] as usize] = kind as u8;
            kind += 1;
        }
        places
    }

    /// Whether the scene has this feature.
    #[inline(always)]
    pub fn has(&self, flag: Flag) -> bool {
        self.flags & flag.bit() != 0
    }
}

/// The words of the lists, which come after [those of the data](Data::of_words).
pub const fn pool_of<const COUNT: usize>(words: &[u64]) -> [u64; COUNT] {
    let mut pool = [0; COUNT];
    let mut place = 0;
    while place < COUNT {
        pool[place] = words[Data::WORDS + place];
        place += 1;
    }
    pool
}

/// Words that a library is compiled with, one after the other.
struct Words<'a> {
    words: &'a [u64],
    next: usize,
}

impl Words<'_> {
    const fn take(&mut self) -> u64 {
        self.next += 1;
        self.words[self.next - 1]
    }

    const fn number(&mut self) -> f64 {
        f64::from_bits(self.take())
    }

    const fn law(&mut self) -> LawNumbers {
        let mut law = LawNumbers { law: self.take(), ..LawNumbers::NONE };
        let mut place = 0;
        while place < law.constants.len() {
            law.constants[place] = self.number();
            place += 1;
        }
        law
    }

    const fn rate(&mut self) -> RateNumbers {
        RateNumbers { form: self.take(), constants: [self.number(), self.number()] }
    }

    const fn bytes<const COUNT: usize>(&mut self) -> [u8; COUNT] {
        let mut bytes = [0; COUNT];
        let mut place = 0;
        while place < COUNT {
            let word = self.take().to_le_bytes();
            let mut byte = 0;
            while byte < 8 {
                bytes[place + byte] = word[byte];
                byte += 1;
            }
            place += 8;
        }
        bytes
    }
}

impl<'a> Contents<'a> {
    /// The words of a list.
    #[inline(always)]
    pub fn list(self, list: List) -> &'a [u64] {
        let [start, length] = self.data.lists.get(list as usize).copied().unwrap_or_default();
        let end = (start as usize).wrapping_add(length as usize);
        self.pool.get(start as usize..end).unwrap_or_default()
    }

    /// The rows of a list.
    #[inline(always)]
    fn rows<const WORDS: usize>(self, list: List) -> &'a [[u64; WORDS]] {
        self.list(list).as_chunks().0
    }

    /// The table with this index.
    #[inline(always)]
    pub fn table(self, index: usize) -> Option<Table> {
        self.rows(List::Tables).get(index).map(Table::of)
    }

    /// Number of tables.
    #[inline(always)]
    pub fn tables(self) -> usize {
        self.rows::<{ Table::WORDS }>(List::Tables).len()
    }

    /// The index of the table of a contact.
    pub fn table_of_contact(self, contact: usize) -> usize {
        self.rows(List::Tables).partition_point(|&[end, ..]: &[u64; Table::WORDS]| end as usize <= contact)
    }

    /// Whether every run has one value.
    #[inline(always)]
    pub fn has_single_values(self) -> bool {
        self.rows::<{ Run::WORDS }>(List::Runs).len() == self.data.values as usize
    }

    /// The run of the value with this index, and the index after the last value of the run before.
    #[inline(always)]
    pub fn run(self, index: usize) -> Option<(Run, usize)> {
        let runs: &[[u64; Run::WORDS]] = self.rows(List::Runs);
        if self.has_single_values() {
            return Some((Run::of(runs.get(index)?), index));
        }
        let place = runs.partition_point(|&[end, ..]| end as usize <= index);
        let begin = place.checked_sub(1).and_then(|before| runs.get(before)).map_or(0, |&[end, ..]| end as usize);
        Some((Run::of(runs.get(place)?), begin))
    }

    /// All runs.
    #[inline(always)]
    pub fn runs(self) -> impl Iterator<Item = Run> + 'a {
        self.rows(List::Runs).iter().map(Run::of)
    }

    /// The source of a parameter of the `table` with this index.
    #[inline(always)]
    pub fn source(self, parameter: Parameter, table: impl FnOnce() -> usize) -> Option<Source> {
        let &[kind, word] = match self.data.sources.get(parameter as usize)? {
            [3, column] => {
                let sources: &[[u64; SOURCE_WORDS]] = self.rows(List::Sources);
                let columns = sources.len().checked_div(self.tables())?;
                sources.get(table().wrapping_mul(columns).wrapping_add(*column as usize))?
            }
            source => source,
        };
        Some(match kind {
            0 => Source::Constant(f64::from_bits(word)),
            1 => Source::Settable(word as usize),
            _ => Source::PerContact(word as isize),
        })
    }

    /// A text.
    #[inline(always)]
    pub fn text(self, text: Text) -> &'a [u8] {
        let end = (text.start as usize).wrapping_add(text.length as usize);
        bytes_of(self.list(List::Texts)).get(text.start as usize..end).unwrap_or_default()
    }

    /// The inverse masses \[1/kg\].
    pub fn inverse_masses(self) -> &'a [f64] {
        numbers_of(self.list(List::InverseMasses))
    }

    /// The numbers of a loading curve of one's own.
    #[inline(always)]
    pub fn curve(self) -> &'a [f64] {
        numbers_of(self.list(List::Curve))
    }
}

/// The number of words before the data.
const HEAD: usize = 5;

/// A hash of the data like FNV-1a, but of whole words. A change of any single word changes it.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm".
fn checksum(data: impl Iterator<Item = u64>) -> u64 {
    data.fold(0xcbf2_9ce4_8422_2325, |sum, word| (sum ^ word).wrapping_mul(0x100_0000_01b3))
}
