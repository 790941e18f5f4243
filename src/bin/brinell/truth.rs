//! The finite-element curves of the folder `truth/`, to be compared with.

/// The truth's unit of indentation is the yield point for this mean pressure over the yield strength.
pub const YIELD_PRESSURE_FACTOR: f64 = 1.1;

const LOADING: &str = include_str!("../../../truth/loading.csv");

/// A point of the loading curve.
pub struct Point {
    /// Indentation in yield indentations.
    pub x: f64,
    /// Force in yield forces.
    pub f: f64,
}

/// The loading curve up to 1000 yield indentations, smoothed over the sawtooth of the mesh.
pub fn loading() -> Vec<Point> {
    let number = |text: &str| text.parse().expect("the truth is a table of numbers");
    let point = |line: &str| {
        let columns: Vec<&str> = line.split(',').collect();
        Point { x: number(columns[0]), f: number(columns[2]) }
    };
    LOADING.lines().skip(1).map(point).collect()
}
