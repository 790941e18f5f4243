//! Bodies that contacts of any kind move: the works balance, and the end does not depend on how time is cut.

use crate::physics::{AnyModel, Random, all_models, loading, model, pair_of, unloading};
use crate::prescribed::rate_dependent_laws;
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{self, AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_contact::rate::{self, Rate, Slow};
use brinell_contact::shared::{InverseMasses, Outcome, Refused, SharedContact, Work, follow, work_of_step};
use brinell_contact::tangential::{Friction, FrictionalContact, FrictionalModel, PlaneContact, Quantity};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Contact, History, Loading, Pair, Surface};

/// Contacts that share bodies, in motion.
#[derive(Clone)]
pub struct Group<M, C> {
    pub models: Vec<M>,
    pub contacts: Vec<C>,
    /// The upper triangle [1/kg].
    pub entries: Vec<f64>,
    pub accelerations: Vec<f64>,
    pub rates: Vec<f64>,
    /// Of all normals, then of the tangents in each direction.
    pub impulses: Vec<f64>,
    pub moments: Vec<f64>,
    pub evaluations: u32,
    /// The largest defect of the balance of work in a step [J].
    pub imbalance: f64,
    /// The largest rate at the end of a step [m/s].
    swiftest: f64,
    /// The largest term of the balance of work in a step [J].
    largest_work: f64,
}

/// Contacts without losses and without friction.
pub type Plain = Group<AnyModel, History>;

pub type LosingModel = losses::Model<AnyLoading, AnyUnloading, AnyLoss>;

/// Contacts with losses.
pub type Losing = Group<LosingModel, losses::History<AnyLoss>>;

/// A model with friction and a loss of this kind.
pub type Rough<X> = FrictionalModel<AnyLoading, AnyUnloading, X>;
pub type OneWay = FrictionalContact<16>;
pub type TwoWays = PlaneContact<16>;
pub type LosingOneWay = FrictionalContact<16, true, losses::History<AnyLoss>>;
pub type LosingTwoWays = PlaneContact<16, true, losses::History<AnyLoss>>;

impl<M, C: Contact<M> + SharedContact<M>> Group<M, C> {
    pub fn new(
        models: Vec<M>,
        gaps: &[f64],
        entries: Vec<f64>,
        accelerations: Vec<f64>,
        rates: Vec<f64>,
    ) -> Group<M, C> {
        let contacts = models.iter().zip(gaps).map(|(model, &gap)| C::start(model, gap).expect("within range"));
        let (contacts, count) = (contacts.collect(), rates.len());
        let (impulses, moments) = (vec![0.0; count], vec![0.0; count]);
        Group {
            models,
            contacts,
            entries,
            accelerations,
            rates,
            impulses,
            moments,
            evaluations: 0,
            imbalance: 0.0,
            swiftest: 0.0,
            largest_work: 0.0,
        }
    }

    /// The same bodies with other contacts at the same depths.
    pub fn with_models<N, D: Contact<N> + SharedContact<N>>(self, model: impl FnMut(&M) -> N) -> Group<N, D> {
        let gaps: Vec<f64> = self.depths().iter().map(|depth| -depth).collect();
        Group::new(self.models.iter().map(model).collect(), &gaps, self.entries, self.accelerations, self.rates)
    }

    pub fn masses(&self) -> InverseMasses<'_> {
        InverseMasses::new(self.contacts.len() * (1 + <C as Contact<M>>::DIRECTIONS), &self.entries)
            .expect("a triangle")
    }

    /// The largest inverse mass [1/kg].
    fn lightest(&self) -> f64 {
        let masses = InverseMasses::new(self.rates.len(), &self.entries).expect("a triangle");
        (0..self.rates.len()).map(|row| masses.of(row, row)).fold(0.0, f64::max)
    }

    pub fn try_step(&mut self, step: f64) -> Result<Outcome, Refused> {
        let before = (self.rates.clone(), self.energy());
        let heat = self.friction_works();
        let entries = self.entries.clone();
        let masses = InverseMasses::new(self.contacts.len() * (1 + <C as Contact<M>>::DIRECTIONS), &entries)
            .expect("a triangle");
        let mut work: Vec<Work<C>> = self.contacts.iter().map(|&contact| Work::new(contact)).collect();
        let (models, accelerations) = (&self.models, &self.accelerations);
        let model = |contact: usize| &models[contact];
        let outcome = follow(&mut self.contacts, model, &masses, accelerations, &mut self.rates, &mut work, step)?;
        self.evaluations += outcome.evaluations;
        let has_fallen = heat.iter().zip(self.friction_works()).any(|(before, after)| after < *before);
        assert!(!has_fallen, "the work of friction fell from {heat:?} to {:?}", self.friction_works());
        for (row, (impulse, moment)) in self.impulses.iter_mut().zip(&mut self.moments).enumerate() {
            let work = &work[row % models.len()];
            let [new_impulse, new_moment] = match (row / models.len()).checked_sub(1) {
                None => [work.impulse(), work.moment()],
                Some(direction) => [work.tangential_impulse(direction), work.tangential_moment(direction)],
            };
            *moment += step * *impulse + new_moment;
            *impulse += new_impulse;
            let work = new_impulse * step * accelerations[row];
            self.largest_work = self.largest_work.max(work.abs());
        }
        let balance = work_of_step(&work, (&before.0, &self.rates), accelerations, step) - (self.energy() - before.1);
        self.imbalance = self.imbalance.max(balance.abs());
        self.swiftest = self.rates.iter().fold(self.swiftest, |swiftest, rate| swiftest.max(rate.abs()));
        Ok(outcome)
    }

    pub fn step(&mut self, step: f64) {
        self.try_step(step).expect("a motion");
    }

    /// What friction has turned into heat at each contact [J]; nothing without friction.
    fn friction_works(&self) -> Vec<f64> {
        let of = |(contact, model): (&C, &M)| match C::HAS_FRICTION {
            true => contact.tangential(model, Quantity::FrictionWork, 0.0),
            false => 0.0,
        };
        self.contacts.iter().zip(&self.models).map(of).collect()
    }

    /// Energy that the contacts have taken up [J].
    pub fn energy(&self) -> f64 {
        let of = |contact: &C, model: &M| {
            let quantities = [Quantity::Energy, Quantity::FrictionWork];
            let friction: f64 = quantities.map(|quantity| contact.tangential(model, quantity, 0.0)).iter().sum();
            contact.work(model) + if C::HAS_FRICTION { friction } else { 0.0 }
        };
        self.contacts.iter().zip(&self.models).map(|(contact, model)| of(contact, model)).sum()
    }

    pub fn depths(&self) -> Vec<f64> {
        self.contacts.iter().map(Contact::<M>::indentation).collect()
    }

    /// The largest difference from another end of the same motion, as a part of `speed` [m/s] and `depth` [m].
    pub fn difference(&self, other: &Group<M, C>, speed: f64, depth: f64) -> f64 {
        let rates = self.rates.iter().zip(&other.rates).map(|(one, other)| (one - other).abs() / speed);
        let depths = self.depths().into_iter().zip(other.depths()).map(|(one, other)| (one - other).abs() / depth);
        rates.chain(depths).fold(0.0, f64::max)
    }
}

/// Bodies that begin to move.
pub struct Start<M, C> {
    pub group: Group<M, C>,
    /// Their kinetic energy [J].
    pub energy: f64,
    /// The length of a step [s], some times as long as an impact.
    pub step: f64,
    /// A depth [m] to which others are compared.
    pub depth: f64,
}

impl<M, C: Contact<M> + SharedContact<M>> Start<M, C> {
    /// The same with other contacts.
    fn with_models<N, D: Contact<N> + SharedContact<N>>(self, model: impl FnMut(&M) -> N) -> Start<N, D> {
        Start { group: self.group.with_models(model), energy: self.energy, step: self.step, depth: self.depth }
    }
}

/// Rigid bodies in space, some of which touch each other and the ground, with any laws. The inverse masses, rates and accelerations
/// also have rows of so many tangential `directions`.
pub fn random_bodies(random: &mut Random, count: usize, directions: usize) -> Start<AnyModel, History> {
    let mut decades = |low: f64, high: f64| 10f64.powf(low + (high - low) * random.next());
    let (radius, modulus) = (decades(-3.0, -1.0), decades(9.0, 11.5));
    let strength = modulus / decades(1.5, 3.0);
    let speed = decades(-2.0, 0.5);
    let bodies = 2 + (random.next() * 3.0) as usize;
    let inverse: Vec<[f64; 2]> = (0..bodies)
        .map(|body| {
            let mass = 7850.0 * 4.2 * radius.powi(3) * (0.3 + random.next());
            // the first one is the ground
            if body == 0 { [0.0; 2] } else { [1.0 / mass, 1.0 / (0.4 * mass * radius * radius)] }
        })
        .collect();
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let vector = |random: &mut Random| [random.next() - 0.5, random.next() - 0.5, random.next() - 0.5];
    let unit = |a: [f64; 3]| a.map(|number| number / dot(a, a).sqrt());
    // each contact has rows for every body, of the normal and of the tangents: a direction and a moment
    let contacts: Vec<[Vec<[[f64; 3]; 2]>; 3]> = (0..count)
        .map(|_| {
            let one = 1 + (random.next() * (bodies - 1) as f64) as usize;
            let other = (one + 1 + (random.next() * (bodies - 1) as f64) as usize) % bodies;
            let normal = unit(vector(random));
            let arm = |random: &mut Random| vector(random).map(|number| number * 2.0 * radius);
            let arms = [arm(random), arm(random)];
            let tangent = unit(cross(normal, [0.3, -0.5, 0.8]));
            [normal, tangent, cross(normal, tangent)].map(|direction| {
                let mut row = vec![[[0.0; 3]; 2]; bodies];
                row[one] = [direction, cross(arms[0], direction)];
                row[other] = [direction, cross(arms[1], direction)].map(|vector| vector.map(|number| -number));
                row
            })
        })
        .collect();
    let of_direction = |direction: usize| contacts.iter().map(move |rows| rows[direction].clone());
    let rows: Vec<Vec<[[f64; 3]; 2]>> = (0..=directions).flat_map(of_direction).collect();
    let mut entries = Vec::new();
    for i in 0..rows.len() {
        for j in i..rows.len() {
            let terms = (0..bodies).map(|body| {
                let ([n, m], [o, p]) = (rows[i][body], rows[j][body]);
                inverse[body][0] * dot(n, o) + inverse[body][1] * dot(m, p)
            });
            entries.push(terms.sum());
        }
    }
    let velocities: Vec<[[f64; 3]; 2]> = (0..bodies)
        .map(|body| {
            let moves = if body == 0 { 0.0 } else { 2.0 * speed };
            [vector(random).map(|number| number * moves), vector(random).map(|number| number * moves / radius)]
        })
        .collect();
    let rates = rows
        .iter()
        .map(|row| row.iter().zip(&velocities).map(|(r, v)| dot(r[0], v[0]) + dot(r[1], v[1])).sum())
        .collect();
    let energy: f64 = (1..bodies)
        .map(|body| {
            let [v, w] = velocities[body];
            0.5 * dot(v, v) / inverse[body][0] + 0.5 * dot(w, w) / inverse[body][1]
        })
        .sum();
    let pair = pair_of(radius, modulus, strength);
    // a line contact has no friction
    let all: Vec<_> = all_models(pair).into_iter().filter(|(_, model)| !model.loading.is_line()).collect();
    let models: Vec<AnyModel> = (0..count)
        .map(|_| {
            let surface = if random.next() < 0.5 { Surface::Dented } else { Surface::Fresh };
            AnyModel { surface, ..all[(random.next() * all.len() as f64) as usize].1 }
        })
        .collect();
    let gaps: Vec<f64> = (0..count).map(|_| (random.next() - 0.3).max(0.0) * 1e-3 * radius).collect();
    let accelerations = (0..rows.len()).map(|_| if random.next() < 0.5 { 9.81 } else { 0.0 }).collect();
    let group = Plain::new(models, &gaps, entries, accelerations, rates);
    let speed = (2.0 * energy * group.lightest()).sqrt();
    Start { step: (1e-1 * radius / speed).min(1e-2), depth: 1e-2 * radius, group, energy }
}

/// A body that touches an earlier dent or another surface, or soon will, and that other forces press there or pull away: from hardly to so
/// strongly that the bodies can't part. `None` beyond the range of the `law`.
pub fn pulled_body(random: &mut Random, law: &AnyModel) -> Option<(Start<AnyModel, History>, Impact)> {
    let surface = if random.next() < 0.5 { Surface::Dented } else { Surface::Fresh };
    let modulus = random.log_uniform(1e8, 1e12);
    let pair = pair_of(random.log_uniform(1e-4, 1.0), modulus, modulus / random.log_uniform(50.0, 1000.0));
    let model = AnyModel { pair, surface, ..*law };
    let mass = random.log_uniform(1e-9, 1e3);
    let yields = pair.yield_point(1.1);
    let yield_speed = (0.8 * yields.force * yields.indentation / mass).sqrt();
    let impact = Impact { mass, speed: yield_speed * random.log_uniform(0.05, 30.0) };
    let prediction = predict(&model, &impact)?;
    let sign = if random.next() < 0.5 { 1.0 } else { -1.0 };
    let contact = prediction.contact_time();
    let acceleration = sign * impact.speed / contact * random.log_uniform(1e-6, 1e3);
    let flights = if sign > 0.0 { 2.0 * impact.speed / acceleration } else { 0.0 };
    let step = contact * 3.0 * random.next() + flights * 4.0 * random.next().powi(3);
    let gap = if random.next() < 0.5 { 0.0 } else { -prediction.max_indentation * (random.next() - 0.5) };
    let group = Plain::new(vec![model], &[gap], vec![1.0 / mass], vec![acceleration], vec![impact.speed]);
    Some((Start { group, energy: impact.energy(), step, depth: 0.1 * impact.speed * step }, impact))
}

/// These bodies with contacts along lines.
pub fn as_rollers(bodies: Plain) -> Plain {
    bodies.with_models(|model| AnyModel { loading: loading("line"), unloading: unloading("line"), ..*model }.prepared())
}

pub const STEEL: Solid = Solid { density: 7850.0, youngs_modulus: 206e9, poissons_ratio: 0.3 };

/// Losses of every kind, one of which makes the surface come loose before the bodies part.
pub const LOSSES: [AnyLoss; 4] = [
    AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.9 }),
    AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.3 }),
    AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target: STEEL }),
    AnyLoss::Plate(Plate { target: STEEL, thickness: 0.01 }),
];

/// Any loss of a contact between steel bodies.
pub fn with_any_loss(random: &mut Random, &plastic: &AnyModel) -> LosingModel {
    losses::Model { plastic, loss: LOSSES[(random.next() * LOSSES.len() as f64) as usize] }
}

/// A loss of the kind 0, 1 or 2 that takes a noticeable part of the energy of this `impact`.
pub fn with_loss(random: &mut Random, &plastic: &AnyModel, kind: usize, impact: &Impact) -> LosingModel {
    let pair = plastic.pair;
    // density for a speed of waves that is far above that of the impact
    let wave_speed = impact.speed * random.log_uniform(50.0, 1e4);
    let density = pair.youngs_modulus / (wave_speed * wave_speed);
    let target = Solid { density, youngs_modulus: pair.youngs_modulus, poissons_ratio: pair.poissons_ratio };
    let loss = match kind {
        0 => AnyLoss::RestitutionFitted(RestitutionFitted {
            restitution: [0.3, 0.7, 0.9, 0.98][(random.next() * 4.0) as usize],
        }),
        1 => AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target }),
        _ => {
            let depth = predict(&plastic, impact).map_or(pair.radius, |found| found.max_indentation);
            let thickness = (depth * pair.radius).sqrt() * random.log_uniform(0.5, 30.0);
            AnyLoss::Plate(Plate { target, thickness })
        }
    };
    LosingModel { plastic, loss }
}

/// A contact of these bodies by a rate-dependent `law`.
pub fn rate_dependent(law: AnyDamped, pair: Pair, mass: f64) -> LosingModel {
    let losses::Model { plastic, loss } = law.model(pair, 0.6, mass);
    let (loading, unloading) = (AnyLoading::Elastic(plastic.loading), AnyUnloading::ContactRadius(plastic.unloading));
    let plastic = AnyModel { pair: plastic.pair, loading, unloading, surface: plastic.surface };
    losses::Model { plastic, loss: AnyLoss::Damper(loss) }
}

/// Models of the strength at a strain rate.
pub const RATES: [Rate; 2] =
    [Rate::JohnsonCook { c: 0.014, reference_rate: 1.0 }, Rate::CowperSymonds { d: 40.4, q: 5.0 }];

/// These bodies with contacts that find their strengths, by one of the [`RATES`] each.
fn rated<M: Slow, C: Contact<M> + SharedContact<M>>(
    random: &mut Random,
    start: Start<M, C>,
) -> Start<rate::Model<M>, rate::History<C>> {
    let mut any = || RATES[usize::from(random.next() < 0.5)];
    start.with_models(|&slow| rate::Model { slow, rate: any(), harder: any() })
}

/// Random bodies with friction in as many directions as their contacts have.
fn random_rough<X: Copy, C: Contact<Rough<X>> + SharedContact<Rough<X>>>(
    random: &mut Random,
    count: usize,
    loss: impl Fn(&mut Random) -> X,
) -> Start<Rough<X>, C> {
    let start = random_bodies(random, count, <C as Contact<Rough<X>>>::DIRECTIONS);
    let start = Start { step: 0.3 * start.step, ..start };
    start.with_models(|normal| {
        // a law without segments has no springs
        let normal = match normal.is_segmented() {
            true => *normal,
            false => AnyModel { unloading: unloading("contact-radius"), loading: loading("johnson"), ..*normal },
        };
        let friction = Friction { coefficient: random.next(), stiffness_ratio: 2.0 * 0.7 / 1.7 };
        FrictionalModel { normal, friction, loss: loss(random) }
    })
}

/// Differences between the ends of steps at once and in parts.
#[derive(Default)]
pub struct Differences {
    all: Vec<f64>,
    /// Those above what is allowed, for motions that forget their start.
    sensitive: usize,
    refused: usize,
}

impl Differences {
    /// Makes a step at once and in each number of `parts`. In each step the works balance to these parts of the energy; a difference above
    /// `allowed` is of the size of that of a motion that starts with nearly the same rates: wedged bodies rattle. `holds` is asserted after
    /// each step.
    pub fn add<M: Clone, C: Contact<M> + SharedContact<M>>(
        &mut self,
        name: &str,
        start: &Start<M, C>,
        (parts, allowed, [balance, of_parts]): (&[u32], f64, [f64; 2]),
        holds: impl Fn(&Group<M, C>),
    ) {
        let &Start { ref group, energy, step, depth } = start;
        let mut whole = group.clone();
        if let Err(refused) = whole.try_step(step) {
            assert!(matches!(refused, Refused::TooLong { .. }), "{name}: {refused:?}");
            self.refused += 1;
            return;
        }
        holds(&whole);
        let lightest = group.lightest();
        for &parts in parts {
            let mut cut = group.clone();
            for _ in 0..parts {
                cut.step(step / f64::from(parts));
                holds(&cut);
            }
            let speed = (2.0 * energy * lightest).sqrt().max(whole.swiftest).max(cut.swiftest);
            let energy = energy.max(whole.energy()).max(0.5 * speed * speed / lightest).max(whole.largest_work);
            for (moved, parts, balance) in [(&whole, 1, balance), (&cut, parts, of_parts)] {
                let missing = moved.imbalance;
                assert!(missing < balance * energy, "{name} in {parts} parts: {missing:e} of {energy:e} J");
            }
            let between = |one: &Group<M, C>| whole.difference(one, speed, depth);
            let difference = between(&cut);
            if difference > allowed {
                let mut near = group.clone();
                let nudge = |row: usize| 1e-11 * speed * ((row * 7 % 5) as f64 - 2.0);
                near.rates.iter_mut().enumerate().for_each(|(row, rate)| *rate += nudge(row));
                near.step(step);
                let nudged = between(&near);
                assert!(
                    difference < 10.0 * nudged,
                    "{name} in {parts} parts: {difference:.1e}, {nudged:.1e} if nudged"
                );
                self.sensitive += 1;
            }
            self.all.push(difference);
        }
    }

    /// The median, and the difference below which 95 % are.
    fn median_and_most(mut self, what: &str) -> [f64; 2] {
        self.all.sort_by(f64::total_cmp);
        let found = [50, 95].map(|part| self.all[self.all.len() * part / 100]);
        let worst = self.all[self.all.len() - 1];
        println!(
            "{what}: median {:.1e}, 95 % below {:.1e}, worst {worst:.1e} of {}; {} sensitive, {} refused",
            found[0],
            found[1],
            self.all.len(),
            self.sensitive,
            self.refused
        );
        found
    }

    /// Asserts that hardly any motion forgot its start or was refused.
    pub fn finish(self, what: &str) {
        let (sensitive, refused, all) = (self.sensitive, self.refused, self.all.len());
        self.median_and_most(what);
        assert!(50 * sensitive < all && 20 * refused < all, "{what}: {sensitive} and {refused} of {all}");
    }
}

const MANY: &[u32] = &[2, 7, 100, 1000];

/// Numbers of parts; a law without segments takes its time.
fn parts_of(model: &AnyModel) -> &'static [u32] {
    if model.loading.is_segmented() { MANY } else { &[3, 50] }
}

#[test]
fn bodies_end_alike_however_time_is_cut_and_their_works_balance() {
    let (mut random, mut alone, mut several) = (Random(11), Differences::default(), Differences::default());
    for _ in 0..5 {
        for (name, law) in all_models(pair_of(5e-3, 2e11, 1e9)) {
            let Some((start, _)) = pulled_body(&mut random, &law) else { continue };
            alone.add(&name, &start, (parts_of(&law), 1e-9, [1e-10; 2]), |_| ());
        }
    }
    for index in 0..300 {
        let start = random_bodies(&mut random, 2 + index % 7, 0);
        let start = if index % 5 == 4 { Start { group: as_rollers(start.group), ..start } } else { start };
        several.add(&format!("{index}"), &start, (&[7, 100], 1e-9, [1e-10; 2]), |_| ());
    }
    alone.finish("one contact");
    several.finish("several");
}

#[test]
fn bodies_with_losses_end_alike_however_time_is_cut_and_their_works_balance() {
    let (mut random, mut alone, mut several) = (Random(77), Differences::default(), Differences::default());
    for (name, law) in all_models(pair_of(5e-3, 2e11, 1e9)) {
        for kind in 0..3 {
            let Some((start, impact)) = pulled_body(&mut random, &law) else { continue };
            let start: Start<_, losses::History<AnyLoss>> =
                start.with_models(|model| with_loss(&mut random, model, kind, &impact));
            alone.add(&name, &start, (parts_of(&law), 2e-9, [1e-9; 2]), |_| ());
        }
    }
    let hertz = model("hertz", "contact-radius");
    for (name, law) in rate_dependent_laws() {
        for _ in 0..3 {
            let (start, impact) = pulled_body(&mut random, &hertz).expect("within range");
            let start: Start<_, losses::History<AnyLoss>> =
                start.with_models(|model| rate_dependent(law, model.pair, impact.mass));
            alone.add(&name, &start, (MANY, 2e-9, [1e-9; 2]), |_| ());
        }
        let (pair, mass) = (pair_of(5e-3, 1.13e11, 3e8), 0.033);
        let model = rate_dependent(law, pair, mass);
        let inverse = [1.0, -1.0, 0.0, 2.0, -1.0, 2.0].map(|entry| entry / mass);
        let group =
            Losing::new(vec![model; 3], &[1e-6, 0.0, 0.0], inverse.into(), vec![9.81, 0.0, 0.0], vec![0.4, 0.0, 0.0]);
        let start = Start { group, energy: 1.5 * mass * 0.16, step: 4e-4, depth: 1e-5 };
        several.add(&name, &start, (&[3, 10, 100, 1000], 2e-9, [1e-10; 2]), |_| ());
    }
    for index in 0..200 {
        let start = random_bodies(&mut random, 2 + index % 7, 0);
        let start: Start<_, losses::History<AnyLoss>> = start.with_models(|model| with_any_loss(&mut random, model));
        several.add(&format!("{index}"), &start, (&[7, 100], 2e-9, [1e-10; 2]), |_| ());
    }
    alone.finish("one contact with a loss");
    several.finish("several with losses");
}

#[test]
fn bodies_whose_strength_is_that_of_each_impact_end_alike_however_time_is_cut_and_their_works_balance() {
    let (mut random, mut plain, mut losing) = (Random(31), Differences::default(), Differences::default());
    let stronger = std::cell::Cell::new(0);
    for index in 0..36 {
        let start = random_bodies(&mut random, 1 + index % 6, 0);
        let start = rated(&mut random, start);
        let found = |group: &Group<_, rate::History<History>>| {
            let is_strong = group.contacts.iter().any(|contact| contact.factors().softer > 1.0);
            stronger.set(stronger.get() + u32::from(is_strong));
        };
        plain.add(&format!("{index}"), &start, (&[7, 100, 1000], 1e-9, [1e-10; 2]), found);
        let start = random_bodies(&mut random, 1 + index % 6, 0);
        let start: Start<_, losses::History<AnyLoss>> = start.with_models(|model| with_any_loss(&mut random, model));
        losing.add(&format!("{index}"), &rated(&mut random, start), (&[7, 100, 1000], 2e-9, [1e-10; 2]), |_| ());
    }
    assert!(stronger.get() > 10_000, "{} steps with a strength", stronger.get());
    plain.finish("strength at the rate");
    losing.finish("strength at the rate, with losses");
}

/// Differences of random bodies with friction.
fn rough<X: Copy, C: Contact<Rough<X>> + SharedContact<Rough<X>>>(
    seed: u64,
    loss: impl Fn(&mut Random) -> X,
) -> Differences {
    let (mut random, mut found) = (Random(seed), Differences::default());
    for index in 0..60 {
        let start = random_rough::<X, C>(&mut random, 1 + index % 6, &loss);
        found.add(&format!("{index}"), &start, (&[3, 50], f64::INFINITY, [1e-10, 1e-3]), assert_bound);
    }
    found
}

/// No tangential force is above Coulomb's bound, for the normal force at the present rates, and no impulse above that of the normal one.
fn assert_bound<X: Copy, C: Contact<Rough<X>> + SharedContact<Rough<X>>>(group: &Group<Rough<X>, C>) {
    let count = group.models.len();
    for (place, (contact, model)) in group.contacts.iter().zip(&group.models).enumerate() {
        let (rate, directions) = (group.rates[place], 0..<C as Contact<Rough<X>>>::DIRECTIONS);
        let tangents = directions.clone().map(|it| contact.tangential(model, Quantity::Force(it), rate).powi(2));
        let (found, limit) = (tangents.sum::<f64>().sqrt(), model.friction.coefficient * contact.force(rate));
        assert!(found <= limit * (1.0 + 1e-12), "contact {place} of {count}: {found:e} N of {limit:e} N");
        let tangents = directions.map(|it| group.impulses[place + (1 + it) * count].powi(2));
        let (slipped, limit) = (tangents.sum::<f64>().sqrt(), model.friction.coefficient * group.impulses[place]);
        // mean forces are found by iteration
        let iterated = 1e-12 * group.swiftest / group.lightest();
        assert!(
            slipped <= limit * (1.0 + 1e-10) + iterated,
            "contact {place} of {count}: an impulse of {slipped} N.s, not {limit} N.s + {iterated} N.s"
        );
    }
}

#[test]
fn random_bodies_with_friction_keep_balance_and_bound_and_hardly_care_how_time_is_cut() {
    for found in [rough::<_, OneWay>(21, |_| ()), rough::<_, TwoWays>(22, |_| ())] {
        assert!(found.all.len() >= 110, "{}", found.all.len());
        let [median, most] = found.median_and_most("friction");
        assert!(median < 1e-5 && most < 1e-3, "{median:.1e}, {most:.1e}");
    }
}

#[test]
fn friction_with_a_loss_keeps_balance_and_bound_and_hardly_cares_how_time_is_cut() {
    let fitted = |random: &mut Random| {
        AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.05 + 0.94 * random.next() })
    };
    for found in [rough::<_, LosingOneWay>(23, fitted), rough::<_, LosingTwoWays>(24, fitted)] {
        assert!(found.all.len() >= 90, "{}", found.all.len());
        let [median, most] = found.median_and_most("friction with a loss");
        assert!(median < 1e-4 && most < 1e-2, "{median:.1e}, {most:.1e}");
    }
}
