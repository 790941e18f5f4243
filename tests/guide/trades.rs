//! The page by trade: each scene of `scenes/trades/` with its numbers, one that can be checked by hand, and what a spring and a damper do.

use crate::read;
use crate::tables::{heading, row, shows};
use brinell_contact::impact::{Impact, Prediction};
use brinell_exporter::numbers::{quantity, significant, with_band};
use brinell_exporter::predict::spread;
use brinell_exporter::rods::Waves;
use brinell_exporter::scene::Scene;
use brinell_exporter::translate::{Request, translate};
use std::f64::consts::PI;
use std::path::Path;

/// A scene in its impact.
struct Trade {
    scene: Scene,
    impact: Impact,
    prediction: Prediction,
}

impl Trade {
    fn named(name: &str) -> Trade {
        let text = read(&Path::new("scenes/trades").join(name).with_extension("toml"));
        let scene = Scene::parse(text, Path::new(name)).expect("a scene");
        let impact = scene.impact_of(0);
        let scene = scene.with_strengths_for(Some(&impact)).expect("an impact within the law");
        let prediction = scene.any_model().predict(&impact).expect("an impact within the law");
        Trade { scene, impact, prediction }
    }

    /// Mean force over the contact, from the change of momentum [N].
    fn mean_force(&self) -> f64 {
        self.impact.mass * self.impact.speed * (1.0 + self.prediction.restitution) / self.prediction.contact_time()
    }

    /// The force without yield, by Hertz's energy [N].
    fn elastic_force(&self) -> f64 {
        let stiffness = self.scene.model().pair.hertz_stiffness();
        stiffness.powf(0.4) * (1.25 * self.impact.mass * self.impact.speed.powi(2)).powf(0.6)
    }

    /// Energy that is lost, over the volume of the dent and the yield strength.
    fn lost_over_volume(&self) -> f64 {
        let Prediction { energy, rebound_energy, residual_indentation: depth, max_contact_radius: radius, .. } =
            self.prediction;
        (energy - rebound_energy) / (0.5 * PI * depth * radius * radius) / self.scene.model().pair.yield_strength
    }

    /// Brinell's hardness of the dent [kgf/mm^2].
    fn hardness(&self, ball: f64) -> f64 {
        let (force, dent) = (self.prediction.max_force / 9.806_65, 2e3 * self.prediction.max_contact_radius);
        force / (0.5 * PI * ball * (ball - (ball * ball - dent * dent).sqrt()))
    }

    /// The numbers of the impact, what was checked by hand, and how a spring and a damper that are tuned to it do at other speeds.
    fn table(&self, by_hand: &str) -> String {
        let Trade { scene, impact, prediction } = self;
        let bands = spread::of_impact(scene, impact, None).map(|(_, bands)| bands);
        let said =
            |name: &str, value: f64, unit| with_band(value, bands.as_ref().and_then(|bands| bands.get(name)), unit);
        let mut rows = vec![
            ("impact", format!("{} at {}", quantity(impact.mass, "kg"), quantity(impact.speed, "m/s"))),
            ("largest force", said("largest force", prediction.max_force, "N")),
            ("depth of the dent", said("dent", prediction.residual_indentation, "m")),
            ("diameter of the dent", quantity(2.0 * prediction.max_contact_radius, "m")),
            ("restitution", said("restitution", prediction.restitution, "")),
            ("contact time", quantity(prediction.contact_time(), "s")),
            ("by hand", by_hand.into()),
        ];
        rows.push(("a spring and a damper, tuned here", self.spring()));
        let rows = rows.iter().map(|(name, value)| row(&[name, value]));
        heading(&["", ""]) + &rows.collect::<String>()
    }

    /// What a linear spring with a damper does that has the restitution and the contact time of this impact: the restitution at a tenth
    /// of the speed and at three times, and here the largest force and the depth.
    fn spring(&self) -> String {
        let speeds = Some((0.1 * self.impact.speed, 3.0 * self.impact.speed));
        let request = Request { tool: "simscape", speeds, step: None, millimetres: false };
        let translation = match translate(&self.scene, &request) {
            Ok(translation) => translation,
            Err(why) => return why.to_string(),
        };
        let promised = &translation.ways[0].promised;
        let at = |place: usize| {
            let restitutions = [promised[place].mean.restitution, translation.wanted[place].restitution];
            let [tool, law] = restitutions.map(|value| significant(value, 3));
            format!("{tool} for {law} at {}", quantity(translation.speeds[place], "m/s"))
        };
        let here = translation.speeds.iter().position(|&speed| speed == translation.speed).expect("it is one of them");
        let [force, depth] = [promised[here].mean.largest_force, promised[here].mean.depth];
        let (force, depth) = (quantity(force, "N"), quantity(depth, "m"));
        let last = translation.speeds.len() - 1;
        format!("restitution {}, {}; here at most {force}, {depth} deep, and no dent", at(0), at(last))
    }
}

#[test]
fn the_page_by_trade_has_the_numbers_of_its_scenes() {
    let shown = |name: &str, by_hand: &dyn Fn(&Trade) -> String| {
        let trade = Trade::named(name);
        let by_hand = by_hand(&trade);
        shows("trades.md", name, &trade.table(&by_hand));
    };
    shown("drop_test", &|it| {
        let height = 0.5 * it.prediction.restitution.powi(2);
        format!("e^2 h = {}: the height of the rebound", quantity(height, "m"))
    });
    shown("valve_seat", &|it| {
        format!(
            "Hertz without yield, K^0.4 (5/4 m v^2)^0.6 = {}: more than that it can't be",
            quantity(it.elastic_force(), "N")
        )
    });
    shown("end_stop", &|it| {
        let mean = it.prediction.energy / it.prediction.max_indentation;
        let ratio = significant(it.prediction.max_force / mean, 3);
        format!(
            "m v^2/(2 d) = {} is the mean force over the depth; the largest is {ratio} times that, between a line (2) and Hertz (2.5)",
            quantity(mean, "N")
        )
    });
    let volume = |it: &Trade| {
        format!(
            "lost energy over the volume of the dent, {} S: below the 3 S of a hardness test, since not all metal flows yet",
            significant(it.lost_over_volume(), 2)
        )
    };
    shown("hammer_blow", &volume);
    shown("shot_peening", &|it| {
        let (mean, ratio) = (it.mean_force(), it.prediction.max_force / it.mean_force());
        format!(
            "m v (1 + e)/t = {} is the mean force; the largest is {} times that, of half a sine 1.57",
            quantity(mean, "N"),
            significant(ratio, 3)
        )
    });
    shown("newtons_cradle", &|it| {
        let (first, second) = (0.5 * (1.0 - it.prediction.restitution), 0.5 * (1.0 + it.prediction.restitution));
        let speed = |part: f64| quantity(part * it.impact.speed, "m/s");
        format!(
            "of two equal balls the second leaves with (1 + e)/2 v = {}, the first goes on with {}",
            speed(second),
            speed(first)
        )
    });
    shown("box_on_feet", &|it| {
        let at_foot = it.impact.mass;
        format!(
            "the mass that one foot feels, {}, is less than that of the box, 300 g, since the box turns",
            quantity(at_foot, "kg")
        )
    });
    shown("hammer_drill", &|it| {
        let waves = Waves::of(&it.scene, it.impact.speed).expect("rods");
        format!(
            "rho c A v/(1 + rho c A/(rho c A')) = {} is the largest force before a wave returns",
            quantity(waves.largest_force, "N")
        )
    });
    shown("hardness_test", &|it| {
        format!(
            "F/(pi D/2 (D - sqrt(D^2 - d^2))) = {} kgf/mm^2, for 200 in the scene",
            significant(it.hardness(10.0), 3)
        )
    });
}
