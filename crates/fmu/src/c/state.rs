//! FMU states: as a copy in memory, and as bytes with a checksum that another process can read.

use super::complaint::Complaint;
use super::handle::Handle;
use super::memory::Memory;
use super::span::Free;
use crate::instance::Instance;
use crate::scene::Scene;
use core::ffi::c_void;

/// The object behind the pointer to a state.
///
/// The instance comes first, as in a component. Both then have the same alignment, and the processor can forward the stores of
/// a save to the loads of a restore.
#[repr(C)]
pub struct Snapshot<S: Scene> {
    /// The saved instance.
    pub instance: Instance<S>,
    mark: u64,
}

impl<S: Scene> Handle for Snapshot<S> {}

/// The common part of the marks of all scenes ("snapshot" in ASCII).
const MARK: u64 = u64::from_be_bytes(*b"snapshot");

/// First bytes of a serialized state, with the version of its layout.
const MAGIC: [u8; 8] = *b"brinell\x04";

/// Layout in words: magic, identity of the scene, number of words, the words of the instance, checksum; all little-endian.
const IDENTITY_AT: usize = 1;
const COUNT_AT: usize = 2;
const WORDS_AT: usize = 3;

impl<S: Scene> Snapshot<S> {
    fn checksum_at() -> usize {
        WORDS_AT + Instance::<S>::words()
    }

    /// Length of a serialized state \[bytes\].
    pub fn serialized_size() -> usize {
        8 * (Self::checksum_at() + 1)
    }

    /// The mark that distinguishes states of this scene from those of other scenes, which may have the same length.
    fn mark() -> u64 {
        MARK ^ S::identity()
    }

    /// The snapshot behind `state`.
    ///
    /// # Errors
    /// [`Complaint::NullPointer`]; [`Complaint::BadState`] for a state of another FMU.
    ///
    /// # Safety
    /// `state` is null or points to at least the size of a snapshot, and nothing else uses that memory meanwhile.
    pub unsafe fn at<'a>(state: *mut c_void) -> Result<&'a mut Snapshot<S>, Complaint> {
        // SAFETY: guaranteed by the caller.
        let snapshot = unsafe { Self::behind(state) }.ok_or(Complaint::NullPointer { argument: "FMUstate" })?;
        if snapshot.mark == Self::mark() {
            Ok(snapshot)
        } else {
            Err(Complaint::BadState { reason: "it was not made by this FMU" })
        }
    }

    /// Copies `instance` to the snapshot at `state`. If there is none, it is allocated from `memory`.
    ///
    /// # Safety
    /// As for [`Snapshot::at`].
    pub unsafe fn store(state: &mut *mut c_void, instance: &Instance<S>, memory: Memory) -> Result<(), Complaint> {
        // SAFETY: guaranteed by the caller.
        unsafe {
            if state.is_null() {
                *state = Self::allocate(memory)?;
            }
            Self::at(*state)?.instance.copy(instance);
        }
        Ok(())
    }

    /// A snapshot of zeros.
    fn allocate(memory: Memory) -> Result<*mut c_void, Complaint> {
        let outside = Instance::<S>::outside();
        let made = memory.allocate(size_of::<Snapshot<S>>() + outside);
        // SAFETY: the memory is large enough and aligned for any object; zeros are a valid snapshot, as they are a valid
        // component. What is behind it belongs to the arrays of its instance.
        unsafe {
            let snapshot = Self::behind(made).ok_or(Complaint::NoMemory)?;
            if outside > 0 {
                made.expose_provenance();
                let free = Free::behind(snapshot, outside);
                snapshot.instance.place(free);
            }
            snapshot.mark = Self::mark();
        }
        Ok(made)
    }

    /// Frees the snapshot at `state`, which was allocated from this `memory`. Null is ignored.
    ///
    /// # Safety
    /// As for [`Snapshot::at`], and the snapshot is not used afterwards.
    pub unsafe fn free(state: &mut *mut c_void, memory: Memory) -> Result<(), Complaint> {
        if !state.is_null() {
            // SAFETY: guaranteed by the caller; a snapshot comes from `allocate`.
            unsafe {
                Self::at(*state)?;
                memory.release(*state);
            }
            *state = core::ptr::null_mut();
        }
        Ok(())
    }

    /// Writes the snapshot to `bytes`.
    ///
    /// # Errors
    /// [`Complaint::BadState`] if there are fewer bytes than [`Snapshot::serialized_size`].
    pub fn serialize(&self, bytes: &mut [u8]) -> Result<(), Complaint> {
        let (slots, _) = bytes.as_chunks_mut();
        if slots.len() <= Self::checksum_at() {
            return Err(Complaint::BadState { reason: "the buffer is too short" });
        }
        let mut writer = Writer { slots: slots.iter_mut(), sum: CHECKSUM_START };
        for word in [u64::from_le_bytes(MAGIC), S::identity(), Instance::<S>::words() as u64] {
            writer.word(word);
        }
        self.instance.save(|word| writer.word(word));
        let sum = writer.sum;
        writer.word(sum);
        Ok(())
    }

    /// A new snapshot from the bytes of [`Snapshot::serialize`].
    ///
    /// # Errors
    /// [`Complaint::BadState`] for another length, another FMU or version, or damaged bytes.
    pub fn deserialize(bytes: &[u8], memory: Memory) -> Result<*mut c_void, Complaint> {
        let bad = |reason| Err(Complaint::BadState { reason });
        let (words, rest) = bytes.as_chunks();
        if words.len() != Self::checksum_at() + 1 || !rest.is_empty() {
            return bad("it doesn't have the length of a state of this FMU");
        }
        let known =
            [(0, u64::from_le_bytes(MAGIC)), (IDENTITY_AT, S::identity()), (COUNT_AT, Instance::<S>::words() as u64)];
        if known.into_iter().any(|(place, expected)| word(words, place) != expected) {
            return bad("it is of another unit or version");
        }
        let summed = words.iter().take(Self::checksum_at());
        let sum = summed.fold(CHECKSUM_START, checksum);
        if sum != word(words, Self::checksum_at()) {
            return bad("its checksum is wrong, it is damaged");
        }
        let made = Self::allocate(memory)?;
        let own = words.get(WORDS_AT..Self::checksum_at()).unwrap_or(&[]);
        // SAFETY: it was created here, nothing else refers to it, and it is freed here.
        unsafe {
            if !Self::at(made)?.instance.load(own) {
                memory.release(made);
                return bad("its values don't make a contact");
            }
        }
        Ok(made)
    }
}

/// A writer of consecutive words, with the checksum of the words written so far.
struct Writer<'a> {
    slots: core::slice::IterMut<'a, [u8; 8]>,
    sum: u64,
}

impl Writer<'_> {
    #[inline(never)]
    fn word(&mut self, word: u64) {
        let bytes = word.to_le_bytes();
        self.sum = checksum(self.sum, &bytes);
        if let Some(slot) = self.slots.next() {
            *slot = bytes;
        }
    }
}

/// The word at `place`.
fn word(words: &[[u8; 8]], place: usize) -> u64 {
    words.get(place).map_or(0, |word| u64::from_le_bytes(*word))
}

/// Initial value of the checksum.
const CHECKSUM_START: u64 = 0xcbf2_9ce4_8422_2325;

/// FNV-1a, 64 bits, byte by byte. A change of any single byte changes it.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm".
fn checksum(sum: u64, word: &[u8; 8]) -> u64 {
    word.iter().fold(sum, |sum, &byte| (sum ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}
