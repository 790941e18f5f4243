//! FMU states: a copy in memory, and bytes that another process can read.

use super::abi::fmi2FMUstate;
use super::memory;
use crate::fault::Fault;
use crate::instance::{Instance, WORDS};
use crate::scene;

/// What an `fmi2FMUstate` points to.
///
/// The instance comes first, as in a component: both then have it at the same alignment, and a processor hands the stores
/// of a save straight on to the loads of a restore.
#[repr(C)]
pub struct Snapshot {
    instance: Instance,
    mark: u64,
}

/// Tells a snapshot from other memory ("snapshot" in ASCII); taken away when it is freed.
const MARK: u64 = u64::from_be_bytes(*b"snapshot");

/// First bytes of a serialized state: what it is, and the version of its layout.
const MAGIC: [u8; 8] = *b"brinell\x01";

/// Layout: magic, GUID, number of words, the words of the instance, checksum; all little-endian.
const GUID_AT: usize = MAGIC.len();
const COUNT_AT: usize = GUID_AT + scene::GUID.len();
const WORDS_AT: usize = COUNT_AT + 8;
const CHECKSUM_AT: usize = WORDS_AT + 8 * WORDS;

/// Length of a serialized state [bytes].
pub const SERIALIZED_SIZE: usize = CHECKSUM_AT + 8;

impl Snapshot {
    /// The snapshot behind `state`.
    ///
    /// # Safety
    /// `state` is null or points to at least as much memory as a snapshot has, which nothing else uses meanwhile.
    pub unsafe fn at<'a>(state: fmi2FMUstate) -> Result<&'a mut Snapshot, Fault> {
        // SAFETY: as the caller promises.
        let snapshot =
            unsafe { state.cast::<Snapshot>().as_mut() }.ok_or(Fault::NullPointer { argument: "FMUstate" })?;
        if snapshot.mark == MARK {
            Ok(snapshot)
        } else {
            Err(Fault::BadState { reason: "it was not made by this unit, or is freed" })
        }
    }

    /// Puts `instance` into the snapshot at `state`, which is made if there is none.
    ///
    /// # Safety
    /// As for [`Snapshot::at`].
    pub unsafe fn store(state: &mut fmi2FMUstate, instance: &Instance) -> Result<(), Fault> {
        if state.is_null() {
            let made = memory::allocate(size_of::<Snapshot>());
            if made.is_null() {
                return Err(Fault::NoMemory);
            }
            // SAFETY: the memory is large enough and aligned for any object.
            unsafe { made.cast::<Snapshot>().write(Snapshot { instance: *instance, mark: MARK }) };
            *state = made;
        } else {
            // SAFETY: as the caller promises.
            unsafe { Snapshot::at(*state)? }.instance = *instance;
        }
        Ok(())
    }

    /// The instance as it was.
    pub fn instance(&self) -> &Instance {
        &self.instance
    }

    /// Frees the snapshot at `state`; null is nothing to free.
    ///
    /// # Safety
    /// As for [`Snapshot::at`], and the snapshot is not used afterwards.
    pub unsafe fn free(state: &mut fmi2FMUstate) -> Result<(), Fault> {
        if !state.is_null() {
            // SAFETY: as the caller promises; a snapshot came from `allocate`.
            unsafe {
                Snapshot::at(*state)?.mark = 0;
                memory::release(*state);
            }
            *state = core::ptr::null_mut();
        }
        Ok(())
    }

    /// Writes the snapshot into `bytes`.
    pub fn serialize(&self, bytes: &mut [u8; SERIALIZED_SIZE]) {
        let checked = bytes.first_chunk_mut::<CHECKSUM_AT>();
        let Some(checked) = checked else { return };
        let head = MAGIC.into_iter().chain(scene::GUID.bytes()).chain((WORDS as u64).to_le_bytes());
        let words = self.instance.to_words();
        let all = head.chain(words.into_iter().flat_map(u64::to_le_bytes));
        for (slot, byte) in checked.iter_mut().zip(all) {
            *slot = byte;
        }
        let sum = checksum(checked).to_le_bytes();
        if let Some(end) = bytes.last_chunk_mut::<8>() {
            *end = sum;
        }
    }
}

/// Reads a state that [`Snapshot::serialize`] wrote.
///
/// # Errors
/// [`Fault::BadState`] for another length, another unit or version, and damaged bytes.
pub fn deserialize(bytes: &[u8]) -> Result<Instance, Fault> {
    let bad = |reason| Err(Fault::BadState { reason });
    if bytes.len() != SERIALIZED_SIZE {
        return bad("it doesn't have the length of a state of this unit");
    }
    let mut parts = Parts(bytes);
    if parts.take(MAGIC.len()) != MAGIC {
        return bad("it is not a serialized state of this version");
    }
    if parts.take(scene::GUID.len()) != scene::GUID.as_bytes() {
        return bad("it is of another unit (its GUID is different)");
    }
    if parts.word() != WORDS as u64 {
        return bad("its number of words is not that of this unit");
    }
    let mut words = [0; WORDS];
    for word in &mut words {
        *word = parts.word();
    }
    let checked = bytes.first_chunk::<CHECKSUM_AT>();
    if checked.is_none_or(|checked| checksum(checked) != parts.word()) {
        return bad("its checksum is wrong, it is damaged");
    }
    Instance::from_words(&words).ok_or(Fault::BadState { reason: "its values don't make a contact" })
}

/// Bytes that are taken from the front.
struct Parts<'a>(&'a [u8]);

impl<'a> Parts<'a> {
    /// The next `count` bytes, or what is left.
    fn take(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at_checked(count).unwrap_or((self.0, &[]));
        self.0 = rest;
        taken
    }

    fn word(&mut self) -> u64 {
        self.take(8).iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte))
    }
}

/// FNV-1a, 64 bits: any single changed byte changes it.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm".
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, &byte| (sum ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}
