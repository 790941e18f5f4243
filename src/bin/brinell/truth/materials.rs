//! The finite-element curves of targets that harden, or with other Poisson's ratios.

use super::{Impact, Point, computed, path, points};

/// A target with its curves.
pub struct Material {
    pub poissons_ratio: f64,
    /// Hardening modulus over Young's modulus.
    pub hardening: f64,
    loading: &'static str,
    unloading: &'static [(f64, &'static str)],
}

impl Material {
    /// The loading curve.
    pub fn loading(&self) -> Vec<Point> {
        points(self.loading)
    }

    /// The impacts with computed unloading, each with its path from the largest indentation.
    pub fn impacts(&self) -> Vec<(Impact, Vec<Point>)> {
        let curve = self.loading();
        self.unloading.iter().map(|(x, rows)| (computed(&curve, *x, rows), path(rows))).collect()
    }
}

/// All targets.
pub const MATERIALS: [Material; 7] = [
    Material {
        poissons_ratio: 0.3,
        hardening: 0.005,
        loading: include_str!("../../../../truth/materials/loading_H0.005.csv"),
        unloading: &[
            (3.0, include_str!("../../../../truth/materials/unloading_H0.005_from_3.csv")),
            (10.0, include_str!("../../../../truth/materials/unloading_H0.005_from_10.csv")),
            (30.0, include_str!("../../../../truth/materials/unloading_H0.005_from_30.csv")),
            (82.5, include_str!("../../../../truth/materials/unloading_H0.005_from_82.5.csv")),
            (200.0, include_str!("../../../../truth/materials/unloading_H0.005_from_200.csv")),
        ],
    },
    Material {
        poissons_ratio: 0.3,
        hardening: 0.02,
        loading: include_str!("../../../../truth/materials/loading_H0.02.csv"),
        unloading: &[
            (3.0, include_str!("../../../../truth/materials/unloading_H0.02_from_3.csv")),
            (10.0, include_str!("../../../../truth/materials/unloading_H0.02_from_10.csv")),
            (30.0, include_str!("../../../../truth/materials/unloading_H0.02_from_30.csv")),
            (82.5, include_str!("../../../../truth/materials/unloading_H0.02_from_82.5.csv")),
            (200.0, include_str!("../../../../truth/materials/unloading_H0.02_from_200.csv")),
        ],
    },
    Material {
        poissons_ratio: 0.3,
        hardening: 0.05,
        loading: include_str!("../../../../truth/materials/loading_H0.05.csv"),
        unloading: &[
            (3.0, include_str!("../../../../truth/materials/unloading_H0.05_from_3.csv")),
            (10.0, include_str!("../../../../truth/materials/unloading_H0.05_from_10.csv")),
            (30.0, include_str!("../../../../truth/materials/unloading_H0.05_from_30.csv")),
            (82.5, include_str!("../../../../truth/materials/unloading_H0.05_from_82.5.csv")),
            (200.0, include_str!("../../../../truth/materials/unloading_H0.05_from_200.csv")),
        ],
    },
    Material {
        poissons_ratio: 0.3,
        hardening: 0.1,
        loading: include_str!("../../../../truth/materials/loading_H0.1.csv"),
        unloading: &[
            (3.0, include_str!("../../../../truth/materials/unloading_H0.1_from_3.csv")),
            (10.0, include_str!("../../../../truth/materials/unloading_H0.1_from_10.csv")),
            (30.0, include_str!("../../../../truth/materials/unloading_H0.1_from_30.csv")),
            (82.5, include_str!("../../../../truth/materials/unloading_H0.1_from_82.5.csv")),
            (200.0, include_str!("../../../../truth/materials/unloading_H0.1_from_200.csv")),
        ],
    },
    Material {
        poissons_ratio: 0.2,
        hardening: 0.0,
        loading: include_str!("../../../../truth/materials/loading_nu0.2.csv"),
        unloading: &[
            (10.0, include_str!("../../../../truth/materials/unloading_nu0.2_from_10.csv")),
            (82.5, include_str!("../../../../truth/materials/unloading_nu0.2_from_82.5.csv")),
        ],
    },
    Material {
        poissons_ratio: 0.4,
        hardening: 0.0,
        loading: include_str!("../../../../truth/materials/loading_nu0.4.csv"),
        unloading: &[
            (10.0, include_str!("../../../../truth/materials/unloading_nu0.4_from_10.csv")),
            (82.5, include_str!("../../../../truth/materials/unloading_nu0.4_from_82.5.csv")),
        ],
    },
    Material {
        poissons_ratio: 0.45,
        hardening: 0.0,
        loading: include_str!("../../../../truth/materials/loading_nu0.45.csv"),
        unloading: &[
            (10.0, include_str!("../../../../truth/materials/unloading_nu0.45_from_10.csv")),
            (82.5, include_str!("../../../../truth/materials/unloading_nu0.45_from_82.5.csv")),
        ],
    },
];
