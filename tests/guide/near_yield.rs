//! The dents near first yield that the page on limits shows.

use crate::physics::AnyModel;
use crate::tables::{heading, row, shows};
use brinell_contact::Loading;
use brinell_exporter::laws;
use brinell_exporter::numbers::significant;
use brinell_exporter::scene::Scene;
use std::f64::consts::PI;
use std::path::Path;

/// A steel ball of 10 mm on a flat of the same steel: radius \[m\], modulus \[Pa\] and Poisson's ratio of both.
const BALL: (f64, f64, f64) = (5e-3, 206e9, 0.3);

/// The strengths of both bodies \[Pa\].
const STRENGTHS: [f64; 3] = [1.7e9, 2.0e9, 2.2e9];

/// The static load rating of ball bearings: the largest Hertzian pressure \[Pa\].
const RATED: f64 = 4.2e9;

/// The load \[N\] under which Hertz's contact has this largest `pressure` \[Pa\].
fn hertz_load(pressure: f64) -> f64 {
    let (radius, modulus, ratio) = BALL;
    let effective = modulus / (2.0 * (1.0 - ratio * ratio));
    PI.powi(3) * radius * radius * pressure.powi(3) / (6.0 * effective * effective)
}

/// The largest `x` up to `high` for which `is_below` holds.
fn last(high: f64, is_below: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, high);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        *(if is_below(middle) { &mut low } else { &mut high }) = middle;
    }
    low
}

/// The law of balls of this strength \[Pa\].
fn model(strength: f64) -> AnyModel {
    let (radius, modulus, ratio) = BALL;
    let body = format!("youngs_modulus = {modulus:?}, poissons_ratio = {ratio:?}, yield_strength = {strength:?}");
    let text = format!(
        "name = \"dent\"\nimpactor = {{ radius = {radius:?}, {body} }}\ntarget = {{ {body} }}\n\
         impact = {{ mass = 1.0, speed = 0.1 }}\n"
    );
    let scene = Scene::parse(text, Path::new("dent.toml")).expect("a scene");
    let mut choices = laws::choose(&scene, &[]).expect("the scene has laws");
    *choices.remove(0).model.elastoplastic().expect("the law yields")
}

#[test]
fn dents_near_first_yield_are_those_of_the_law() {
    let mut table = heading(&[
        "strength S of both",
        "first yield at",
        "1e-4 of the diameter at",
        "there, indentation over that at first yield",
        "dent at 4.2 GPa",
    ]);
    let radius = BALL.0;
    for strength in STRENGTHS {
        let model = model(strength);
        let force = |d: f64| model.loading.segment(&model.pair, d).force(d);
        let dent = |d: f64| model.unloading_path(d).lower;
        let yields = model.yield_point();
        // from a load back to the largest pressure that Hertz's contact would have
        let pressure = |load: f64| last(100e9, |pressure| hertz_load(pressure) < load);
        let deepest = 0.1 * radius;
        let rated = last(deepest, |d| dent(d) < 1e-4 * 2.0 * radius);
        let loaded = last(deepest, |d| force(d) < hertz_load(RATED));
        let stronger = self::model(1.01 * strength);
        let less = last(deepest, |d| stronger.loading.segment(&stronger.pair, d).force(d) < hertz_load(RATED));
        let change = 1.0 - stronger.unloading_path(less).lower / dent(loaded);
        assert!((0.035..0.125).contains(&change), "one percent of the strength changes the dent by {change}");
        table += &row(&[
            &format!("{:.1} GPa", 1e-9 * strength),
            &format!("{:.1} GPa", 1e-9 * pressure(yields.force)),
            &format!("{:.1} GPa", 1e-9 * pressure(force(rated))),
            &format!("{:.1}", rated / yields.indentation),
            &format!("{} um", significant(1e6 * dent(loaded), 3)),
        ]);
    }
    shows("limits.md", "dents near first yield", &table);
}
