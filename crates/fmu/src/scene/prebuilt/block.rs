//! The data of a scene as a block of memory inside a prebuilt library.
//!
//! The exporter fills it in; the library only reads it. All numbers are 64-bit words, little-endian as on every supported
//! platform.

use crate::scene::Parameter;

/// First word of every block ("brinell" and a zero).
pub const MAGIC: u64 = u64::from_le_bytes(*b"brinell\0");

/// Version of the layout.
pub const VERSION: u64 = 4;

/// Capacity for variables.
pub const VARIABLES: usize = 64;

/// Capacity for texts \[bytes\].
pub const TEXTS: usize = 512;

/// Length of a GUID \[bytes\].
pub const GUID: usize = 32;

/// The code of a value reference without a variable.
pub const NO_VARIABLE: u8 = u8::MAX;

/// The first code that denotes a parameter. The codes follow the order of [`Parameter`].
pub const FIRST_PARAMETER: u8 = 128;

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
    /// Length of the data \[words\]; zero in a block that has not been filled in.
    pub length: u64,
    /// Hash of the data.
    pub checksum: u64,
    /// The scene.
    pub data: Data,
}

/// The data that differ between the scenes of one library.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Data {
    /// A number that identifies the scene; no other scene has it.
    pub identity: u64,
    /// The [flags](Flag) of the scene.
    pub flags: u64,
    /// The parameters that can be set, one bit each.
    pub settable: u64,
    /// Effective mass of the scene's impact \[kg\] if the step size is to be checked, otherwise NaN.
    pub impact_mass: f64,
    /// Density of the target \[kg/m^3\]; NaN if unknown.
    pub density: f64,
    /// The values of all parameters, in the order of [`Parameter`].
    pub starts: [f64; Parameter::PREBUILT],
    /// The smallest value of each parameter that can be set.
    pub minima: [f64; Parameter::PREBUILT],
    /// The largest value of each parameter that can be set.
    pub maxima: [f64; Parameter::PREBUILT],
    /// The meaning of each value reference: the index of a variable in the table of variables, or a parameter.
    pub variables: [u8; VARIABLES],
    /// The GUID.
    pub guid: [u8; GUID],
    /// Name and unit of each parameter that can be set, or two empty texts; each text ends with 0.
    pub texts: [u8; TEXTS],
}

/// A feature of a scene, as a bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Flag {
    /// A new contact meets a fresh surface.
    Fresh = 0,
    /// The acceleration by all forces except the contact force is an input.
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

    /// The data of no scene.
    pub const EMPTY: Data = Data {
        identity: 0,
        flags: 0,
        settable: 0,
        impact_mass: f64::NAN,
        density: f64::NAN,
        starts: [0.0; Parameter::PREBUILT],
        minima: [0.0; Parameter::PREBUILT],
        maxima: [0.0; Parameter::PREBUILT],
        variables: [NO_VARIABLE; VARIABLES],
        guid: [0; GUID],
        texts: [0; TEXTS],
    };

    /// Whether the scene has this feature.
    #[inline(always)]
    pub fn has(&self, flag: Flag) -> bool {
        self.flags & flag.bit() != 0
    }

    /// Whether this parameter can be set.
    pub fn is_settable(&self, parameter: usize) -> bool {
        parameter < Parameter::PREBUILT && self.settable >> parameter & 1 != 0
    }

    /// The text with this index; empty after the last one.
    #[inline(never)]
    pub fn text(&self, place: usize) -> &[u8] {
        self.texts.split(|&byte| byte == 0).nth(place).unwrap_or_default()
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

/// The number of words before the data.
const HEAD: usize = 5;

/// A hash of the data like FNV-1a, but of whole words. A change of any single word changes it.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm".
fn checksum(data: impl Iterator<Item = u64>) -> u64 {
    data.fold(0xcbf2_9ce4_8422_2325, |sum, word| (sum ^ word).wrapping_mul(0x100_0000_01b3))
}

const _: () = assert!(size_of::<Block>() == 8 * (HEAD + 5 + 3 * Parameter::PREBUILT + (VARIABLES + GUID + TEXTS) / 8));
