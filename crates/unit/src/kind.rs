//! The features of this library, if it is a prebuilt one.
//!
//! `brinell prebuild` writes this file for every library that it builds. The file in the source tree is that of the kind
//! `force` with the laws of `scenes/steel_ball.toml`; a test compares it with the output of the program.

brinell_fmu::scene::kind! {
    library: "unpacked",
    two_strengths: false,
    laws: plain {
        plain BigAlabo { yield_pressure_factor: 1.1, plastic_pressure_factor: 2.8, second_region: 13.93, fully_plastic: 82.5, plastic_slope: 5.09090909090909 },
        plain ContactRadius {}
    },
    parts: { Momentum = Absent, Course = Present, Prediction = Absent, Coupling = Absent, Watch = Absent },
    reals: { 0: IndentationRate, 1: Force, 2: Indentation, 4: ResidualIndentation, 11: DissipatedEnergy },
    integers: {},
}
