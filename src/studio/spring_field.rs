//! The numbers of a custom spring, each with the command that sets it.

use super::command::ViewCommand;
use super::my_spring::MySpring;
use crate::scene::entered_tick_rate;
use crate::sim::TickRate;
use crate::tools::port::{Key, USUAL_FRAME_HZ, UiSpring, Wish};

/// A number of a spring, or the spring's tick rate.
pub struct SpringField {
    /// Name of the number, for people.
    pub name: &'static str,
    /// Unit of the number. Empty if it has none.
    pub unit: &'static str,
    /// Present value of the number.
    pub value: f64,
    /// Whether a drag changes the number in whole steps.
    pub is_whole: bool,
    /// Returns the command that sets another value, or an error message.
    pub set: Box<dyn Fn(f64) -> Result<ViewCommand, String>>,
}

/// Returns the command that sets this spring, or an error message if no scene may have its numbers.
fn describe(spring: MySpring) -> Result<ViewCommand, String> {
    spring.check().map(|()| ViewCommand::DescribeSpring(spring))
}

impl SpringField {
    fn new(
        name: &'static str,
        unit: &'static str,
        value: f64,
        with: impl Fn(f64) -> MySpring + 'static,
    ) -> Self {
        Self { name, unit, value, is_whole: false, set: Box::new(move |it| describe(with(it))) }
    }

    /// Creates the fields for the mass, the stiffness and the damping.
    pub fn constant_fields(spring: MySpring) -> [Self; 3] {
        let MySpring { mass_kg, stiffness_n_per_m, damping_n_s_per_m, .. } = spring;
        [
            Self::new("mass", "kg", mass_kg, move |mass_kg| MySpring { mass_kg, ..spring }),
            Self::new("stiffness", "N/m", stiffness_n_per_m, move |stiffness_n_per_m| MySpring {
                stiffness_n_per_m,
                ..spring
            }),
            Self::new("damping", "N·s/m", damping_n_s_per_m, move |damping_n_s_per_m| MySpring {
                damping_n_s_per_m,
                ..spring
            }),
        ]
    }

    /// Creates the fields for the frequency and the damping ratio, which describe the motion independently of the mass.
    pub fn motion_fields(spring: MySpring) -> [Self; 2] {
        let [hz, ratio] = [spring.frequency_hz(), spring.damping_ratio()];
        [
            Self::new("frequency", "Hz", hz, move |hz| spring.swinging(hz, ratio)),
            Self::new("damping ratio", "", ratio, move |ratio| spring.swinging(hz, ratio)),
        ]
    }

    /// Creates the fields for the numbers of a library's spring. If the library has no mass, the spring keeps its own.
    pub fn of_dialect(dialect: &'static UiSpring, values: &[f64], spring: MySpring) -> Vec<Self> {
        let number = |(index, key): (usize, &'static Key)| {
            let (value, values) = (values[index], values.to_vec());
            let set = move |value| {
                let mut told = values.clone();
                told[index] = value;
                // The line of code turns on any switch that the motion needs.
                let switches =
                    dialect.keys.iter().zip(&mut told).filter(|(key, _)| key.switch.is_some());
                switches.for_each(|(_, told)| *told = 1.0);
                let wish = dialect.shown(&told, USUAL_FRAME_HZ)?;
                let mass_kg = if dialect.has_mass() { wish.mass_kg } else { spring.mass_kg };
                describe(spring.with_wish(&Wish { mass_kg, ..wish }))
            };
            Self { name: key.name, unit: "", value, is_whole: false, set: Box::new(set) }
        };
        dialect
            .keys
            .iter()
            .enumerate()
            .filter(|(_, key)| key.switch.is_none())
            .map(number)
            .collect()
    }

    /// Creates the fields for the release: stretch and velocity at the start, and gravity.
    pub fn of_release(spring: MySpring) -> [Self; 3] {
        let MySpring { x0_m, v0_m_per_s, gravity_m_per_s2, .. } = spring;
        [
            Self::new("stretch at start", "m", x0_m, move |x0_m| MySpring { x0_m, ..spring }),
            Self::new("velocity at start", "m/s", v0_m_per_s, move |v0_m_per_s| MySpring {
                v0_m_per_s,
                ..spring
            }),
            Self::new("gravity", "m/s²", gravity_m_per_s2, move |gravity_m_per_s2| MySpring {
                gravity_m_per_s2,
                ..spring
            }),
        ]
    }

    /// Creates the field for the tick rate of the spring.
    pub fn tick_rate(tick_hz: impl Into<TickRate>) -> Self {
        let set = |value: f64| entered_tick_rate(value).map(ViewCommand::SpringTickHz);
        let (value, set) = (tick_hz.into().hz(), Box::new(set));
        Self { name: "tick rate", unit: "Hz", value, is_whole: true, set }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::check_entered;
    use crate::sim::bodies::kind;

    #[test]
    fn my_spring_refuses_numbers_with_the_messages_of_the_inspector() {
        let parameters = &kind("spring").unwrap().parameters;
        let spring = MySpring::default();
        let fields =
            SpringField::constant_fields(spring).into_iter().chain(SpringField::of_release(spring));
        let mut shared = 0;
        for field in fields {
            let Some(parameter) = parameters.iter().find(|it| it.quantity() == field.name) else {
                assert_eq!(field.name, "gravity");
                continue;
            };
            assert_eq!(parameter.unit, field.unit, "{}", field.name);
            for value in [-5.0, 0.0, 1e-300, 1e-13, 1e13, -1e13, 1e308] {
                let inspected = check_entered(field.name, value, parameter.range);
                let dialog = (field.set)(value).map(drop);
                if let Err(words) = &inspected {
                    assert!(words.starts_with(field.name) && words.contains("must be"), "{words}");
                    assert_eq!(inspected, dialog, "{} {value}", field.name);
                    shared += 1;
                }
            }
        }
        assert!(shared > 20, "{shared}");
        let told = |value: f64| (SpringField::constant_fields(spring)[0].set)(value).unwrap_err();
        assert_eq!(told(-5.0), "mass would be -5; it must be from 1e-12 to 1e12");
        assert_eq!(told(1e-300), "mass would be 1e-300; it must be from 1e-12 to 1e12");
        // Errors also name numbers that are derived from the entered ones.
        let [frequency, _] = SpringField::motion_fields(spring);
        let words = (frequency.set)(1e200).unwrap_err();
        assert!(words.starts_with("stiffness would be too large for a number; it must"), "{words}");
    }
}
