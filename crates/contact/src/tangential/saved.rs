//! The springs of a contact as words for storage.

use super::{List, Stuck, Vertex};
use crate::path::Sum;
use crate::segment::Segment;
use crate::words::{load_numbers, store_numbers};

impl<const N: usize, const PARTS: u32> Stuck<N, PARTS> {
    /// Number of words in the saved springs of a contact.
    pub const WORDS: usize = 3 + 3 * N;

    /// Passes [`Stuck::WORDS`] words to `store`. Forces are not saved: they follow from the curve.
    pub fn save(&self, store: &mut impl FnMut(u64)) {
        store_numbers(&[self.displacement.value, self.displacement.rest], store);
        let vertices = self.list.vertices();
        store(vertices.len() as u64);
        let stored = vertices.iter().map(|vertex| [vertex.height, vertex.offset, vertex.slope]);
        for numbers in stored.chain(core::iter::repeat([0.0; 3])).take(N) {
            store_numbers(&numbers, store);
        }
    }

    /// The springs that [`Stuck::save`] has stored, on the same `curve`. `None` if a word is not a finite number, or
    /// if there are more segments than fit into the list.
    pub fn load(words: &mut impl Iterator<Item = u64>, curve: &Segment) -> Option<Self> {
        let [value, rest] = load_numbers(words)?;
        let count = words.next().and_then(|count| usize::try_from(count).ok()).filter(|&count| count <= N)?;
        let mut list = List::EMPTY;
        for index in 0..N {
            let [height, offset, slope] = load_numbers(words)?;
            if index < count {
                list.push(curve, Vertex::new(curve, height, offset, slope));
            }
        }
        Some(Stuck { displacement: Sum { value, rest }, list })
    }
}
