//! The springs of a contact in two directions as words for storage.

use super::{List, Stuck, Vertex};
use crate::path::Sum;
use crate::segment::Segment;
use crate::words::{load_numbers, store_numbers};

impl<const N: usize> Stuck<N> {
    /// Number of words in the saved springs of a contact.
    pub const WORDS: usize = 6 + 5 * N;

    /// Passes [`Stuck::WORDS`] words to `store`. Forces are not saved: they follow from the curve.
    pub fn save(&self, store: &mut impl FnMut(u64)) {
        for sum in self.displacement {
            store_numbers(&[sum.value, sum.rest], store);
        }
        store_numbers(&[self.slips_from], store);
        let vertices = self.list.vertices();
        store(vertices.len() as u64);
        let stored = vertices.iter().map(|vertex| {
            let ([offset, offset_two], [slope, slope_two]) = (vertex.offset, vertex.slope);
            [vertex.height, offset, offset_two, slope, slope_two]
        });
        for numbers in stored.chain(core::iter::repeat([0.0; 5])).take(N) {
            store_numbers(&numbers, store);
        }
    }

    /// The springs that [`Stuck::save`] has stored, on the same `curve`. `None` if a word is not a finite number, or
    /// if there are more segments than fit into the list.
    pub fn load(words: &mut impl Iterator<Item = u64>, curve: &Segment) -> Option<Stuck<N>> {
        let [value, rest, value_two, rest_two, slips_from] = load_numbers(words)?;
        let count = words.next().and_then(|count| usize::try_from(count).ok()).filter(|&count| count <= N)?;
        let mut list = List::EMPTY;
        for index in 0..N {
            let [height, offset, offset_two, slope, slope_two] = load_numbers(words)?;
            if index < count {
                list.add(Vertex::new(curve, height, [offset, offset_two], [slope, slope_two]));
            }
        }
        let displacement = [Sum { value, rest }, Sum { value: value_two, rest: rest_two }];
        Some(Stuck { displacement, list, slips_from })
    }
}
