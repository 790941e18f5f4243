//! The scene of this library.
//!
//! `brinell export` writes this file for every scene that it builds. The file in the source tree is that
//! of `scenes/steel_ball.toml`, without identification; a test compares it with the output of the exporter.

brinell_fmu::scene::scene! {
    guid: "unpacked",
    contacts: 1 in 1,
    tables: [("", false, 1)],
    surface: [Dented],
    density: [Some(7850.0)],
    laws: plain {
        plain BigAlabo { yield_pressure_factor: 1.1, plastic_pressure_factor: 2.8, second_region: 13.93, fully_plastic: 82.5, plastic_slope: 5.09090909090909 },
        plain ContactRadius {}
    },
    parts: { Forces = Absent, Momentum = Absent, Course = Present, Prediction = Absent, Coupling = Absent, Watch = Absent, Shared = Absent, InverseMasses = [f64; 0], Prepared = Absent },
    settable: {
        "impactor.radius" "m" [1e-12, 1e9] = 0.005,
        "target.youngs_modulus" "Pa" [1.0, 1e18] = 2.06e11,
        "target.poissons_ratio" "" [-0.99, 0.5] = 0.3,
        "target.yield_strength" "Pa" [1e-9, 1e18] = 3e8,
        "initial_gap" "m" [-1e6, 1e6] = 0.0,
    },
    parameters: {
        ImpactorRadius: set 0,
        TargetYoungsModulus: set 1,
        TargetPoissonsRatio: set 2,
        TargetYieldStrength: set 3,
        InitialGap: set 4,
    },
    kinds: 5,
    reals: { 0: IndentationRate, 1: Force, 2: Indentation, 3: ResidualIndentation, 4: DissipatedEnergy },
    integers: {},
}
