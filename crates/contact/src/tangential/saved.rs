//! The springs of a contact as words for storage.

use super::{PlayOperator, Vertex};
use crate::history::path::Sum;
use crate::numerics::words::{load_numbers, store_numbers};
use crate::segment::Segment;

impl<const D: usize, const N: usize> PlayOperator<D, N> {
    /// Number of words in the saved springs of a contact. Along a line, the springs that slipped follow from the slopes.
    pub const WORDS: usize = 2 * D + (D > 1) as usize + 1 + (1 + 2 * D) * N;

    /// Passes [`PlayOperator::WORDS`] words to `store`. Forces are not saved: they follow from the curve.
    pub fn save(&self, store: &mut impl FnMut(u64)) {
        for sum in self.displacement {
            store_numbers(&[sum.value, sum.rest], store);
        }
        if D > 1 {
            store_numbers(&[self.slips_from], store);
        }
        let vertices = self.list.vertices();
        store(vertices.len() as u64);
        for vertex in vertices.iter().chain(core::iter::repeat(&Vertex::NONE)).take(N) {
            store_numbers(&[vertex.height], store);
            store_numbers(&vertex.offset, store);
            store_numbers(&vertex.slope, store);
        }
    }

    /// The springs that [`PlayOperator::save`] has stored, on the same `curve`. `None` if a word is not a finite number, or
    /// if there are more segments than fit into the list.
    pub fn load(words: &mut impl Iterator<Item = u64>, curve: &Segment) -> Option<Self> {
        let mut stuck = PlayOperator::APART;
        for sum in &mut stuck.displacement {
            let [value, rest] = load_numbers(words)?;
            *sum = Sum { value, rest };
        }
        if D > 1 {
            [stuck.slips_from] = load_numbers(words)?;
        }
        let count = words.next().and_then(|count| usize::try_from(count).ok()).filter(|&count| count <= N)?;
        for index in 0..N {
            let ([height], offset, slope) = (load_numbers(words)?, load_numbers(words)?, load_numbers(words)?);
            if index < count {
                stuck.list.add(Vertex::new(curve, height, offset, slope));
            }
        }
        Some(stuck)
    }
}
