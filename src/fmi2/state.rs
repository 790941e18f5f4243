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
    /// The instance as it was.
    pub instance: Instance,
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
        // SAFETY: as the caller promises.
        unsafe {
            if state.is_null() {
                *state = Snapshot::allocate()?;
            }
            Snapshot::at(*state)?.instance.copy(instance);
        }
        Ok(())
    }

    /// A snapshot of nothing.
    fn allocate() -> Result<fmi2FMUstate, Fault> {
        let made = memory::allocate(size_of::<Snapshot>());
        // SAFETY: the memory is large enough and aligned for any object, and zeros are a snapshot as they are a component.
        unsafe { made.cast::<Snapshot>().as_mut() }.ok_or(Fault::NoMemory)?.mark = MARK;
        Ok(made)
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
        let mut writer = Writer { slots: bytes.iter_mut(), sum: CHECKSUM_START };
        writer.put(&MAGIC);
        writer.put(scene::GUID.as_bytes());
        writer.word(WORDS as u64);
        self.instance.to_words(|word| writer.word(word));
        let sum = writer.sum;
        writer.word(sum);
    }

    /// Makes the snapshot at `state`, which is made if there is none, from what [`Snapshot::serialize`] wrote.
    ///
    /// # Errors
    /// [`Fault::BadState`] for another length, another unit or version, and damaged bytes; `state` is then as it was.
    ///
    /// # Safety
    /// As for [`Snapshot::at`].
    pub unsafe fn deserialize(state: &mut fmi2FMUstate, bytes: &[u8]) -> Result<(), Fault> {
        check(bytes)?;
        let (words, _) = bytes.get(WORDS_AT..).unwrap_or(&[]).as_chunks();
        let made = if state.is_null() { Snapshot::allocate()? } else { *state };
        // SAFETY: as the caller promises; what was made here is released here.
        unsafe {
            if !Snapshot::at(made)?.instance.restore(words) {
                if state.is_null() {
                    memory::release(made);
                }
                return Err(Fault::BadState { reason: "its values don't make a contact" });
            }
        }
        *state = made;
        Ok(())
    }
}

/// Bytes that are written one after the other, and the checksum of those written so far.
struct Writer<'a> {
    slots: core::slice::IterMut<'a, u8>,
    sum: u64,
}

impl Writer<'_> {
    #[inline(never)]
    fn put(&mut self, bytes: &[u8]) {
        for (&byte, slot) in bytes.iter().zip(&mut self.slots) {
            self.sum = checksum(self.sum, byte);
            *slot = byte;
        }
    }

    #[inline(never)]
    fn word(&mut self, word: u64) {
        self.put(&word.to_le_bytes());
    }
}

/// Whether `bytes` are whole, and of this unit.
fn check(bytes: &[u8]) -> Result<(), Fault> {
    let bad = |reason| Err(Fault::BadState { reason });
    if bytes.len() != SERIALIZED_SIZE {
        return bad("it doesn't have the length of a state of this unit");
    }
    let head = [u64::from_le_bytes(MAGIC), WORDS as u64];
    let guid = bytes.iter().skip(GUID_AT).zip(scene::GUID.as_bytes()).all(|(one, other)| one == other);
    if [word(bytes, 0), word(bytes, COUNT_AT)] != head || !guid {
        return bad("it is of another unit or version");
    }
    let sum = bytes.iter().take(CHECKSUM_AT).fold(CHECKSUM_START, |sum, &byte| checksum(sum, byte));
    if sum != word(bytes, CHECKSUM_AT) {
        return bad("its checksum is wrong, it is damaged");
    }
    Ok(())
}

/// The word that begins at `place`.
#[inline(never)]
fn word(bytes: &[u8], place: usize) -> u64 {
    bytes.get(place..).and_then(|rest| rest.first_chunk()).map_or(0, |word| u64::from_le_bytes(*word))
}

/// What a checksum begins with.
const CHECKSUM_START: u64 = 0xcbf2_9ce4_8422_2325;

/// FNV-1a, 64 bits: any single changed byte changes it.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm".
fn checksum(sum: u64, byte: u8) -> u64 {
    (sum ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
}
