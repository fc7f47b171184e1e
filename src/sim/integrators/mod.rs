//! The methods, each with a file of its own and a line in the table below.
//!
//! A method implements [`Integrator`] for every [`System`] and describes itself on a [`Method`] card. If it steps
//! [only](Only) some bodies, its card names them, and its step fails on others. Menus, command line, help and tests
//! loop over [`METHODS`], and the conformance suite measures each field of each card. A [custom](Method::custom) method
//! needs no place in the table. To add a method to the table, copy `midpoint.rs`, declare the copy, and name it in
//! `methods!`.

use super::state::Vector;
use super::system::{BodyClass, Counted, Coupling, EngineSettings, Query, System};
use custom_method::{CustomMethod, Unfit};
use reset_on_change::ResetOnChange;

mod adams_bashforth_2;
mod adaptive_euler;
mod adaptive_euler_as_printed;
mod avian;
mod avian_motor;
mod bdf2;
mod bogacki_shampine_32;
mod box2d;
mod box2d_2;
mod box3d;
mod bullet;
mod bullet_6dof;
mod buss_2;
mod buss_3;
mod buss_enhanced;
mod cannon;
mod card;
mod chipmunk;
mod critically_damped_spring;
mod custom_method;
mod dormand_prince_54;
mod engine;
mod engine_bounce;
mod excalibur;
mod explicit_euler;
mod exponential_decay;
mod exponential_rosenbrock_euler;
mod failure;
mod follower;
mod free_spin;
mod gauss_legendre_4;
mod godot;
mod gyro;
mod gyro_explicit;
mod gyro_midpoint;
mod gyro_newton;
mod gyro_off;
mod gyro_rescaled;
mod gyro_rk4;
mod gyro_rotated;
mod gyro_rotated_engine;
mod havok;
mod held_force;
mod implicit_euler;
mod implicit_midpoint;
mod implicit_spring;
mod improved_euler;
mod improved_euler_as_printed;
mod integrator;
mod jakobsen_verlet;
mod joint_mode;
mod jolt;
mod lerp_dt;
mod lerp_per_frame;
mod lie_midpoint;
mod lie_rk4;
mod linearly_implicit_euler;
mod matter;
mod midpoint;
mod momentum_euler;
mod moser_veselov;
mod mujoco;
mod mujoco_discrete;
mod mujoco_rk4;
mod nape;
mod newmark;
mod newton_xpbd;
mod oimo;
mod oimo_symplectic;
mod only;
mod pefrl;
mod phaser_arcade;
mod physx;
mod physx_tgs;
mod physx_tgs_56;
mod position_verlet;
mod prelude;
mod pybullet;
mod qt_spring;
mod rapier;
mod react_spring;
mod reanimated;
mod reset_on_change;
mod rk4;
mod rk4_as_printed;
mod semi_implicit_euler;
mod semi_implicit_euler_implicit_drag;
mod shared;
mod smooth_damp;
mod spelling;
mod split_3;
mod split_5;
mod ssp_rk3;
#[cfg(feature = "lab")]
pub(crate) mod step_method;
#[cfg(feature = "lab")]
pub(crate) mod step_rule;
mod stormer_verlet;
mod tr_bdf2;
mod velocity_verlet;
mod verlet_exact_drag;
mod yoshida4;

pub use card::{
    Carded, DAMPING_RATIOS, Engine, Family, FollowerQuantity, FollowerSetting, Method, Substeps,
};
pub use custom_method::{AnyIntegrator, AnySystem, BuildIntegrator, custom_integrator};
pub use engine::{EngineMethod, EngineRule, EngineTick};
pub use engine_bounce::EngineBounce;
pub use failure::{StepFailure, Stepped};
pub use follower::{Follower, FollowerRule};
pub use free_spin::{FreeSpin, SpinMap};
pub use gyro::{Gyro, GyroRule, Turned};
pub use integrator::{CloneIntegrator, Integrator, Override, Tolerance};
pub use joint_mode::{JointMode, JointQuantity, OtherEngine, Setting, in_code};
pub use only::{Needs, Only};
pub use shared::embedded_pair::{EmbeddedPair, Pair};
pub use spelling::{UnknownMethod, method_or_nearest, plain};

/// A system of erased type with coordinates of type `V`, so that methods are compiled only once for all such systems.
/// It counts evaluations.
pub type Problem<V> = Counted<Box<dyn System<Vector = V>>>;

/// Returns this system as a problem, with its counter at zero. Without an answer to the engine query it has no joint.
pub fn problem<S: System<Vector: Vector> + 'static>(system: S) -> Problem<S::Vector> {
    struct Answering<S>(S);
    impl<S: System> System for Answering<S> {
        type Vector = S::Vector;
        fn coupling(&self) -> Coupling {
            self.0.coupling()
        }
        fn generation(&self) -> u64 {
            self.0.generation()
        }
        fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
            self.0.acceleration(t, q, v, a);
        }
        fn query(&self, t: f64, query: Query<'_, S::Vector>) -> bool {
            let Query::Engine { state, settings, force } = query else {
                return self.0.query(t, query);
            };
            *settings = EngineSettings::of(&self.0, t, state, force);
            true
        }
    }
    Counted::new(Box::new(Answering(system)))
}

/// An integrator of systems of type `S`. Like all methods, it also steps every other system with the same vector.
pub trait MethodOf<S: System>:
    Integrator<S> + Integrator<Problem<S::Vector>> + AnyIntegrator<S::Vector> + Clone + 'static
{
}

impl<S: System, I> MethodOf<S> for I where
    I: Integrator<S> + Integrator<Problem<S::Vector>> + AnyIntegrator<S::Vector> + Clone + 'static
{
}

/// Builds a value from an integrator whose type is chosen at run time by [`construct`].
pub trait Construct<S: System> {
    /// The built value.
    type Output;
    /// The class of the bodies; `None` if it is unknown. Methods that refuse this class are not compiled.
    const CLASS: Option<BodyClass> = None;
    /// Builds the value from integrators of type `I`. Each call of `new` makes one for coordinate vectors shaped like
    /// its argument.
    fn of<I: MethodOf<S>>(self, new: impl FnOnce(&S::Vector) -> I) -> Self::Output;
}

/// Returns the reason why a method steps no system for which `C` constructs; `None` if it may step some.
const fn refusal<S: System, C: Construct<S>>(card: &Method) -> Option<&'static str> {
    match C::CLASS {
        Some(class) => card.incompatibility(class),
        None => None,
    }
}

/// The type of a method on coordinates of type `V`, which is the method's own type, or that of its rule's family.
macro_rules! method_type {
    ($V:ty, $Type:ident) => { $Type<$V> };
    ($V:ty, $Rule:ident, $Family:ident) => { $Family<$V, $Rule> };
}

/// Gives a rule the card of its file.
macro_rules! carded {
    ($file:ident, $Type:ident) => {};
    ($file:ident, $Rule:ident, $Family:ident) => {
        impl Carded for $Rule {
            const CARD: &'static Method = &$file::CARD;
        }
    };
}

/// Returns the result of `construct` if `method` is this method and steps blocks.
#[cfg(feature = "batch")]
macro_rules! construct_in_blocks {
    ($S:ident, $method:ident, $construct:ident, $file:ident, $Type:ident, blocks) => {
        if $method.id == $file::CARD.id {
            return Some($construct.of(<$Type<$S::Vector> as Integrator<$S>>::new));
        }
    };
    ($S:ident, $method:ident, $construct:ident, $file:ident, $Type:ident) => {};
}

/// The id of a method that steps blocks.
#[cfg(feature = "batch")]
macro_rules! id_in_blocks {
    ($file:ident, blocks) => {
        $file::CARD.id
    };
}

macro_rules! methods {
    ($($file:ident::$Type:ident $(as $Family:ident)? $(in $blocks:ident)?),+ $(,)?) => {
        $(pub use $file::$Type;)+
        $(carded!($file, $Type $(, $Family)?);)+

        /// Every method, in the order of the digit keys and of race lanes.
        pub static METHODS: &[Method] = &[$(Method {
            code: include_str!(concat!("../../../assets/methods/", stringify!($file), ".step")),
            ..$file::CARD
        }),+];

        /// Calls `construct` with the integrator type of `method`, for systems with this coupling.
        ///
        /// If the method steps no such system, the integrator [refuses](StepFailure::Refused) every step.
        ///
        /// # Panics
        /// If `method` is neither from [`METHODS`] nor [from outside](Method::is_from_outside).
        pub fn construct<S: System<Vector: Vector>, C: Construct<S>>(
            method: &Method,
            coupling: Coupling,
            construct: C,
        ) -> C::Output {
            if let Some(custom) = method.custom {
                return construct.of(|like| CustomMethod::new(custom, like, coupling));
            }
            $(if const { refusal::<S, C>(&$file::CARD).is_none() } {
                if method.id == $file::CARD.id {
                    return construct.of(|like| {
                        <method_type!(S::Vector, $Type $(, $Family)?) as Integrator<S>>::coupled(like, coupling)
                    });
                }
            })+
            let Some(reason) = refusal::<S, C>(method) else {
                panic!("{} is not in METHODS, and its card has no `custom`", method.id)
            };
            construct.of(|_| Unfit { reason })
        }

        /// Calls `construct` with the integrator type of `method` for blocks of bodies. Returns `None` if the method
        /// does not step each number by itself.
        #[cfg(feature = "batch")]
        pub(crate) fn construct_in_blocks<S: System, C: Construct<S>>(
            method: &Method,
            construct: C,
        ) -> Option<C::Output> {
            $(construct_in_blocks!(S, method, construct, $file, $Type $(, $blocks)?);)+
            None
        }

        /// Whether `method` steps each number by itself, and can thus step copies in blocks.
        #[cfg(feature = "batch")]
        pub fn steps_in_blocks(method: &Method) -> bool {
            [$($(id_in_blocks!($file, $blocks),)?)+].contains(&method.id)
        }
    };
}

methods! {
    explicit_euler::ExplicitEuler in blocks,
    midpoint::Midpoint in blocks,
    improved_euler::ImprovedEuler in blocks,
    ssp_rk3::SspRk3 in blocks,
    rk4::Rk4 in blocks,
    adams_bashforth_2::AdamsBashforth2 in blocks,
    semi_implicit_euler::SemiImplicitEuler in blocks,
    velocity_verlet::VelocityVerlet in blocks,
    position_verlet::PositionVerlet in blocks,
    stormer_verlet::StormerVerlet in blocks,
    yoshida4::Yoshida4 in blocks,
    pefrl::Pefrl in blocks,
    adaptive_euler::AdaptiveEuler,
    bogacki_shampine_32::BogackiShampine32,
    dormand_prince_54::DormandPrince54,
    implicit_euler::ImplicitEuler,
    implicit_midpoint::ImplicitMidpoint,
    newmark::Newmark,
    bdf2::Bdf2,
    gauss_legendre_4::GaussLegendre4,
    tr_bdf2::TrBdf2,
    linearly_implicit_euler::LinearlyImplicitEuler,
    semi_implicit_euler_implicit_drag::SemiImplicitEulerImplicitDrag,
    verlet_exact_drag::VerletExactDrag,
    exponential_rosenbrock_euler::ExponentialRosenbrockEuler,
    improved_euler_as_printed::ImprovedEulerAsPrinted in blocks,
    rk4_as_printed::Rk4AsPrinted in blocks,
    adaptive_euler_as_printed::AdaptiveEulerAsPrinted,
    jakobsen_verlet::JakobsenVerlet in blocks,
    lerp_per_frame::LerpPerFrame as Follower,
    lerp_dt::LerpDt as Follower,
    exponential_decay::ExponentialDecay as Follower,
    smooth_damp::SmoothDamp as Follower,
    critically_damped_spring::CriticallyDampedSpring as Follower,
    implicit_spring::ImplicitSpring as Follower,
    box2d::Box2d as EngineMethod,
    rapier::Rapier as EngineMethod,
    avian::Avian as EngineMethod,
    avian_motor::AvianMotor as EngineMethod,
    jolt::Jolt as EngineMethod,
    physx::Physx as EngineMethod,
    physx_tgs::PhysxTgs as EngineMethod,
    physx_tgs_56::PhysxTgs56 as EngineMethod,
    bullet::Bullet as EngineMethod,
    pybullet::Pybullet as EngineMethod,
    chipmunk::Chipmunk as EngineMethod,
    mujoco::Mujoco as EngineMethod,
    mujoco_rk4::MujocoRk4 as EngineMethod,
    godot::Godot as EngineMethod,
    box3d::Box3d as EngineMethod,
    box2d_2::Box2dV2 as EngineMethod,
    cannon::Cannon as EngineMethod,
    matter::Matter as EngineMethod,
    havok::Havok as EngineMethod,
    oimo::Oimo as EngineMethod,
    oimo_symplectic::OimoSymplectic as EngineMethod,
    nape::Nape as EngineMethod,
    phaser_arcade::PhaserArcade as EngineMethod,
    excalibur::Excalibur as EngineMethod,
    mujoco_discrete::MujocoDiscrete as EngineMethod,
    bullet_6dof::Bullet6dof as EngineMethod,
    newton_xpbd::NewtonXpbd as EngineMethod,
    held_force::HeldForce as EngineMethod,
    gyro_off::GyroOff as Gyro,
    gyro_explicit::GyroExplicit as Gyro,
    gyro_newton::GyroNewton as Gyro,
    gyro_rescaled::GyroRescaled as Gyro,
    gyro_rotated::GyroRotated as Gyro,
    gyro_rotated_engine::GyroRotatedEngine as Gyro,
    momentum_euler::MomentumEuler as Gyro,
    buss_2::Buss2 as Gyro,
    buss_enhanced::BussEnhanced as Gyro,
    buss_3::Buss3 as Gyro,
    gyro_midpoint::GyroMidpoint as Gyro,
    lie_midpoint::LieMidpoint as Gyro,
    split_3::Split3 as Gyro,
    split_5::Split5 as Gyro,
    moser_veselov::MoserVeselov as Gyro,
    lie_rk4::LieRk4 as Gyro,
    gyro_rk4::GyroRk4 as Gyro,
    react_spring::ReactSpring as EngineMethod,
    qt_spring::QtSpring as EngineMethod,
    reanimated::Reanimated as EngineMethod,
}

/// Returns an integrator of `method` for bodies of this class and coupling, compiled once for each vector type.
///
/// # Panics
/// The same as for [`construct`].
pub(crate) fn any_integrator<V: Vector>(
    method: &Method,
    class: BodyClass,
    coupling: Coupling,
    like: &V,
) -> Box<dyn AnyIntegrator<V>> {
    struct Boxed<'a, V>(&'a V);
    impl<V: Vector> Construct<Problem<V>> for Boxed<'_, V> {
        type Output = Box<dyn AnyIntegrator<V>>;

        fn of<I: MethodOf<Problem<V>>>(self, new: impl FnOnce(&V) -> I) -> Self::Output {
            Box::new(new(self.0))
        }
    }
    match method.incompatibility(class) {
        Some(reason) if !method.is_from_outside() => Box::new(Unfit { reason }),
        _ => construct(method, coupling, Boxed(like)),
    }
}

/// Number of methods at the beginning of [`METHODS`] that step every body.
const GENERAL_COUNT: usize = {
    let mut count = 0;
    while count < METHODS.len() && METHODS[count].only.is_none() {
        count += 1;
    }
    count
};

/// The methods that step every body, which are the part of [`METHODS`] before the first method for [`Only`] some
/// bodies.
pub static GENERAL_METHODS: &[Method] = METHODS.split_at(GENERAL_COUNT).0;

/// Returns the id of a value in a table of all values.
fn id_in<T: PartialEq>(all: &[(&'static str, T)], value: T) -> &'static str {
    all.iter().find(|(_, listed)| *listed == value).expect("the table has every value").0
}

/// Returns the method with this id.
pub fn method(id: &str) -> Option<&'static Method> {
    METHODS.iter().find(|method| method.id == id)
}

/// Returns a new integrator of `method` for any system with coordinates shaped `like` these. It
/// [resets](Integrator::reset) itself if its state is not the one that it returned, or if the
/// [generation](System::generation) of the forces is not that of the last step. A caller whose system has no generation
/// must call [`Integrator::reset`] when the forces jump.
///
/// An [engine](Family::Engine)'s method that has a joint refuses a system that answers no [engine
/// query](crate::Query::Engine): it would hold the whole force for a tick, as every other engine does.
///
/// A system that borrows, such as the level of a game, has no boxed integrator. It is stepped by the method's own type,
/// which is two to six times as fast for a cheap step, and resets nothing by itself:
///
/// ```
/// # use regatta_sim::{State, System, integrators::{Integrator, Rk4}};
/// struct Leaf<'a> {
///     wind_m_per_s: &'a [f64],
/// }
///
/// impl System for Leaf<'_> {
///     type Vector = f64;
///     fn acceleration(&self, t: f64, _x: &f64, v: &f64, a: &mut f64) {
///         *a = 2.0 * (self.wind_m_per_s[t as usize % self.wind_m_per_s.len()] - v);
///     }
/// }
///
/// let mut state = State { q: 0.0, v: 0.0 };
/// let mut rk4 = <Rk4<f64> as Integrator<Leaf>>::new(&state.q);
/// for tick in 0..120 {
///     let gusts = [4.0, 7.0];
///     let leaf = Leaf { wind_m_per_s: &gusts };
///     rk4.step(&leaf, f64::from(tick) / 60.0, 1.0 / 60.0, &mut state).unwrap();
/// }
/// assert!(state.q > 7.0 && state.q < 9.0);
/// ```
///
/// ```
/// # use regatta_sim::{State, bodies::Spring, integrators::{integrator, method}};
/// let spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.0, x0: 1.0, v0: 0.0, kick: 1.0 };
/// let mut state = State { q: 1.0, v: 0.0 };
/// let mut rk4 = integrator(method("rk4").unwrap(), &state.q);
/// rk4.step(&spring, 0.0, 1.0 / 60.0, &mut state).unwrap();
/// assert!(state.q < 1.0);
/// ```
pub fn integrator<S: System<Vector: Vector> + 'static>(
    method: &Method,
    like: &S::Vector,
) -> Box<dyn Integrator<S>> {
    integrator_for(method, Coupling::All, like)
}

/// Returns an integrator as [`integrator()`] does, but only for systems with this [coupling](System::coupling). A
/// method that solves equations saves much of its work if each coordinate depends on few others.
pub fn integrator_for<S: System<Vector: Vector> + 'static>(
    method: &Method,
    coupling: Coupling,
    like: &S::Vector,
) -> Box<dyn Integrator<S>> {
    struct Boxed<'a, V>(&'a V);
    impl<S: System<Vector: Vector> + 'static> Construct<S> for Boxed<'_, S::Vector> {
        type Output = Box<dyn Integrator<S>>;
        fn of<I: MethodOf<S>>(self, new: impl FnOnce(&S::Vector) -> I) -> Self::Output {
            let mut method = new(self.0);
            Integrator::<S>::set(&mut method, Override::EngineQuery);
            Box::new(ResetOnChange::around(method, self.0))
        }
    }
    construct::<S, _>(method, coupling, Boxed(like))
}

/// Returns a fresh [integrator](integrator()) for problems of one coordinate. Generic functions are compiled again in
/// each crate that uses them, but this function is not.
pub fn fresh(method: &Method) -> Box<dyn Integrator<Problem<f64>>> {
    integrator(method, &0.0)
}
