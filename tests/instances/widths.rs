//! A contact is small beside the smaller of its bodies: a warning from 0.3 of its radius on, and no step to a contact as wide as that.

use super::*;
use brinell_contact::Surface;
use brinell_contact::validity::size_of;
use brinell_fmu::instance::Warning;
use scenes::Lossy;

/// Radii of a ball and of what it meets: a flat, a ball, a socket that hardly differs from it, of all sizes.
fn radii(random: &mut Random) -> [f64; 2] {
    let ball = random.log_uniform(1e-6, 1e2);
    let other = ball * random.log_uniform(1e-2, 1e2);
    let socket = -ball * (1.0 + random.log_uniform(1e-4, 1e2));
    [ball, [f64::INFINITY, other, socket, socket][(4.0 * random.next()) as usize]]
}

/// Presses all contacts by `way` \[m\], in so many steps.
fn press<S: Scene>(instance: &mut Instance<S>, way: f64, steps: u32) -> Result<(), Fault> {
    (0..S::contacts()).for_each(|contact| set_rate(instance, contact, way));
    for _ in 0..steps {
        let (time, step) = (instance.time(), 1.0 / f64::from(steps));
        if instance.do_plain_step(time, step) != Plain::Done {
            instance.do_step(time, step)?;
        }
    }
    Ok(())
}

/// Warns at 0.3 of the smaller body (or of the effective radius, if that is the narrower one), and refuses a contact as wide as the body, in
/// whatever steps it gets there.
/// Returns false where a fitted law ends before.
fn keeps_the_size<S: Scene>(what: &str, [narrower, size]: [f64; 2], random: &mut Random) -> bool {
    let mut instance = ready::<S>();
    let steps = |random: &mut Random| random.log_uniform(1.0, 60.0) as u32;
    // by the law itself: pressed until the FMU's own output is as wide as wanted
    let depth_at = |wanted: f64| {
        let (mut low, mut high) = (0.0, 4.0 * wanted);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let mut other = ready::<S>();
            let narrow = press(&mut other, middle, 1).is_ok() && other.real((Real::ContactRadius, 0)) < wanted;
            *(if narrow { &mut low } else { &mut high }) = middle;
        }
        low
    };
    let [valid, possible] = [0.3 * narrower, size].map(depth_at);
    let ends = |depth: f64| matches!(press(&mut ready::<S>(), 1.001 * depth, 1), Err(Fault::TooDeep { .. }));
    if [valid, possible].into_iter().any(ends) {
        return false;
    }
    press(&mut instance, 0.999 * valid, steps(random)).unwrap();
    assert_eq!(instance.take_deep(), None, "{what}");
    press(&mut instance, 0.002 * valid, 1).unwrap();
    assert!(matches!(instance.take_deep(), Some(Warning::Deep { .. })), "{what}");
    press(&mut instance, 0.999 * possible - 1.001 * valid, steps(random)).unwrap();
    let wide = instance.real((Real::ContactRadius, 0)) / size;
    assert!((0.998..1.0).contains(&wide), "{what}: refused from {wide} on");
    let before = words(&instance);
    let time = instance.time();
    let refused = press(&mut instance, 0.002 * possible, 1).unwrap_err();
    assert!(matches!(refused, Fault::TooWide { .. }), "{what}: {refused:?}");
    // the rates were set
    (0..S::contacts()).for_each(|contact| set_rate(&mut instance, contact, 0.0));
    let mut again = ready::<S>();
    let bytes: Vec<[u8; 8]> = before.iter().map(|word| word.to_le_bytes()).collect();
    assert!(again.load(&bytes));
    (0..S::contacts()).for_each(|contact| set_rate(&mut again, contact, 0.0));
    assert_eq!(words(&again), words(&instance), "{what}: nothing else has changed");
    assert_eq!(instance.time(), time);
    // a single step from the air is no way round
    let mut at_once = ready::<S>();
    assert!(matches!(press(&mut at_once, 1.001 * possible, 1), Err(Fault::TooWide { .. })), "{what}");
    true
}

#[test]
fn a_contact_is_warned_of_at_three_tenths_of_the_smaller_body_and_refused_at_its_radius() {
    let mut random = Random(61);
    let pairings = some_pairings();
    let mut judged = 0;
    for round in 0..24 {
        let [radius, target_radius] = radii(&mut random);
        let (name, choice) = &pairings[round % pairings.len()];
        let surface = if round % 3 == 0 { Surface::Fresh } else { Surface::Dented };
        // stiff against soft, so that the contact is wide with and without yield; each following target is stiffer
        let yield_strength = 206e9 * random.log_uniform(1e-4, 1.0);
        let (_, damped) = AnyDamped::ALL[round % AnyDamped::ALL.len()];
        // on a plate the way of the bodies is not the indentation
        let loss = LOSSES[round % 2];
        choose(Choice { radius, target_radius, surface, yield_strength, damped, loss, ..*choice });
        let size = size_of([radius, target_radius]);
        let effective = 1.0 / (1.0 / radius + 1.0 / target_radius);
        let sizes = [size.min(effective), size];
        let what = format!("{name} with radii of {radius:e} m and {target_radius:e} m");
        let kinds = [
            keeps_the_size::<One>(&what, sizes, &mut random),
            keeps_the_size::<Chosen<Elastoplastic, 1>>(&what, sizes, &mut random),
            keeps_the_size::<DampedOne>(&what, sizes, &mut random),
            keeps_the_size::<Chosen<Lossy, 1, Present>>(&what, sizes, &mut random),
            round % 4 == 0 && keeps_the_size::<RoughOne>(&what, sizes, &mut random),
        ];
        judged += kinds.into_iter().filter(|judged| *judged).count();
    }
    assert!(judged > 70, "{judged} of 102");
}
