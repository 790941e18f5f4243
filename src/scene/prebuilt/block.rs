//! The data of a scene as a block of memory inside of a prebuilt library.
//!
//! The exporter fills it in; the library reads it and nothing else. All numbers are words of 64 bits, little-endian as on every
//! platform that units are made for.

use crate::scene::Parameter;

/// First word of every block ("brinell" and a zero).
pub const MAGIC: u64 = u64::from_le_bytes(*b"brinell\0");

/// Version of the layout.
pub const VERSION: u64 = 2;

/// Room for the variables.
pub const VARIABLES: usize = 64;

/// Room for the texts \[bytes\].
pub const TEXTS: usize = 512;

/// Length of a GUID \[bytes\].
pub const GUID: usize = 32;

/// A value reference that no variable has.
pub const NO_VARIABLE: u8 = u8::MAX;

/// The first of the codes that mean a parameter; the [`Parameter`]s follow in order.
pub const FIRST_PARAMETER: u8 = 128;

/// The block: what it is and how long, and the data.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Block {
    /// [`MAGIC`].
    pub magic: u64,
    /// [`VERSION`].
    pub version: u64,
    /// Which library the data are for.
    pub library: u64,
    /// Words of the data; none in a block that has not been filled in.
    pub length: u64,
    /// Hash of the data.
    pub checksum: u64,
    /// The scene.
    pub data: Data,
}

/// What differs between the scenes of one library.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Data {
    /// A number that no other scene has.
    pub identity: u64,
    /// The [flags](Flag) of the scene.
    pub flags: u64,
    /// The parameters that can be set, as bits.
    pub settable: u64,
    /// Effective mass of the scene's impact \[kg\], if steps are to be watched; or NaN.
    pub impact_mass: f64,
    /// Density of the target \[kg/m^3\], or NaN.
    pub density: f64,
    /// The values of all parameters, in their order.
    pub starts: [f64; Parameter::COUNT],
    /// The smallest value of each parameter that can be set.
    pub minima: [f64; Parameter::COUNT],
    /// The largest.
    pub maxima: [f64; Parameter::COUNT],
    /// What each value reference means: the place of a variable in the table of variables, or a parameter.
    pub variables: [u8; VARIABLES],
    /// The GUID.
    pub guid: [u8; GUID],
    /// Name and unit of each parameter that can be set, or two empty texts; each ends with 0.
    pub texts: [u8; TEXTS],
}

/// Something that a scene has or hasn't got, as a bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Flag {
    /// A new contact meets a fresh surface.
    Fresh = 0,
    /// The acceleration by all other forces is an input.
    Acceleration = 1,
    /// The effective mass is an input.
    Mass = 2,
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
        Block { magic: MAGIC, version: VERSION, library, length: 0, checksum: 0, data: Data::EMPTY }
    }

    /// A block with these `data` for a `library`.
    pub fn filled(library: u64, data: Data) -> Block {
        let mut block = Block { length: Data::WORDS as u64, data, ..Block::unfilled(library) };
        block.checksum = checksum(block.data.words());
        block
    }

    /// Whether the block, which has these `words`, is one for this `library`, and whole.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check(&self, words: &[u64; Block::WORDS], library: u64) -> Result<(), &'static str> {
        if self.magic != MAGIC || self.version != VERSION {
            Err("the data of this prebuilt library have another version")
        } else if self.length == 0 {
            Err("this prebuilt library has no scene: `brinell export` puts one in")
        } else if self.library != library {
            Err("the data of this prebuilt library were made for another library")
        } else if self.length != Data::WORDS as u64 || self.checksum != checksum(words.iter().skip(HEAD).copied()) {
            Err("the data of this prebuilt library are damaged")
        } else {
            Ok(())
        }
    }

    /// The words of the block as they lie in memory.
    pub fn words(&self) -> impl Iterator<Item = u64> {
        [self.magic, self.version, self.library, self.length, self.checksum].into_iter().chain(self.data.words())
    }
}

impl Data {
    /// Length of the data \[words\].
    const WORDS: usize = size_of::<Data>() / 8;

    /// No scene.
    pub const EMPTY: Data = Data {
        identity: 0,
        flags: 0,
        settable: 0,
        impact_mass: f64::NAN,
        density: f64::NAN,
        starts: [0.0; Parameter::COUNT],
        minima: [0.0; Parameter::COUNT],
        maxima: [0.0; Parameter::COUNT],
        variables: [NO_VARIABLE; VARIABLES],
        guid: [0; GUID],
        texts: [0; TEXTS],
    };

    /// Whether the scene has this.
    #[inline(always)]
    pub fn has(&self, flag: Flag) -> bool {
        self.flags & flag.bit() != 0
    }

    /// Whether this parameter can be set.
    pub fn is_settable(&self, parameter: usize) -> bool {
        parameter < Parameter::COUNT && self.settable >> parameter & 1 != 0
    }

    /// The GUID.
    pub fn guid(&self) -> &str {
        core::str::from_utf8(&self.guid).unwrap_or_default()
    }

    /// The text at this place; none behind the last one.
    #[inline(never)]
    pub fn text(&self, place: usize) -> &str {
        let text = self.texts.split(|&byte| byte == 0).nth(place).unwrap_or_default();
        core::str::from_utf8(text).unwrap_or_default()
    }

    /// The words of the data as they lie in memory.
    fn words(&self) -> impl Iterator<Item = u64> {
        let numbers = [self.impact_mass, self.density].into_iter().chain(self.starts).chain(self.minima);
        let (variables, _) = self.variables.as_chunks();
        let (texts, _) = self.texts.as_chunks();
        let (guid, _) = self.guid.as_chunks();
        let bytes = variables.iter().chain(guid).chain(texts).map(|bytes| u64::from_le_bytes(*bytes));
        let numbers = numbers.chain(self.maxima).map(f64::to_bits);
        [self.identity, self.flags, self.settable].into_iter().chain(numbers).chain(bytes)
    }
}

/// The words before the data.
const HEAD: usize = 5;

/// A hash of the data, after FNV-1a but of whole words: any single changed word changes it.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm".
fn checksum(data: impl Iterator<Item = u64>) -> u64 {
    data.fold(0xcbf2_9ce4_8422_2325, |sum, word| (sum ^ word).wrapping_mul(0x100_0000_01b3))
}

const _: () = assert!(size_of::<Block>() == 8 * (HEAD + 5 + 3 * Parameter::COUNT + (VARIABLES + GUID + TEXTS) / 8));
