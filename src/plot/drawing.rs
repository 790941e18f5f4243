//! The axes of a picture, and its lines in the coordinates of the drawing.

use super::colours::{self, data, grey};
use super::lines::{self, Frame, Line, Place};
use super::{IN_MEMORY, Picture, Point, SCALE, Series, View, clip, label};
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::prelude::*;
use std::iter;
use std::ops::Range;

/// A picture over its two axes.
pub struct Drawing<'a> {
    pub picture: &'a Picture,
    pub view: &'a View,
    /// Range of the values.
    pub range: Range<f64>,
    /// Range in the drawing [1/8 pixel].
    pub width: i32,
}

impl Drawing<'_> {
    /// Draws the axes; returns the lines.
    pub fn draw<'a, X, Y>(
        &self,
        chart: Result<ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>, DrawingAreaErrorKind<std::io::Error>>,
    ) -> String
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let mut chart = chart.expect(IN_MEMORY);
        let font = |size: u32| ("sans-serif", SCALE * size);
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(221, 221, 221).stroke_width(SCALE))
            .axis_style(BLACK.stroke_width(SCALE))
            .set_all_tick_mark_size(5 * SCALE)
            .x_label_formatter(&label)
            .y_label_formatter(&label)
            .x_desc(&self.picture.x_title)
            .y_desc(&self.picture.y_title)
            .axis_desc_style(font(15))
            .label_style(font(13))
            .draw()
            .expect(IN_MEMORY);
        let (x, y) = chart.plotting_area().get_pixel_range();
        let frame = Frame { left: x.start, right: x.end, bottom: y.end, width: self.width };
        let start = chart.x_range().start;
        let marks = self.view.marks.iter().map(|(value, name)| (chart.backend_coord(&(start, *value)).1, *name));
        let lines = self.lines(&|point| chart.backend_coord(point));
        lines::write(&lines, &marks.collect::<Vec<_>>(), frame, self.view.name_at)
    }

    /// The series as lines; `place` maps values to the drawing.
    fn lines(&self, place: &dyn Fn(&Point) -> (i32, i32)) -> Vec<Line> {
        let Drawing { picture, view, range, .. } = self;
        let placed = |(at, value): clip::Shown| {
            let (x, y) = place(&at);
            Place { x, y, value }
        };
        let line = |(series, stroke): (&Series, colours::Stroke)| {
            let strong = view.shows(&series.label);
            let stroke = if series.dots {
                data(&series.label)
            } else if strong {
                stroke
            } else {
                grey()
            };
            let pieces = picture.pieces(series).flat_map(|piece| clip::inside(picture, piece, range));
            let pieces: Vec<Vec<Place>> = pieces.map(|piece| piece.into_iter().map(placed).collect()).collect();
            let below = picture.pieces(series).all(|piece| clip::is_below(piece, range)) && !pieces.is_empty();
            Line { name: series.label.clone(), stroke, pieces, dots: series.dots, strong, below, bare: view.bare }
        };
        iter::zip(&picture.series, picture.strokes()).map(line).collect()
    }
}
