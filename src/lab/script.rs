//! A scene's script as it is played, and who has which input in hand.

use super::command::Command;
use super::scene::Scripted;

/// The commands of a scene's script, and how far it has been played.
#[derive(Clone, Debug, Default)]
pub(super) struct Script {
    /// By tick, and within a tick in the order of the file.
    commands: Vec<Scripted>,
    next: usize,
}

impl Script {
    /// These commands, none of which is played yet.
    pub(super) fn new(commands: &[Scripted]) -> Self {
        Self { commands: commands.to_vec(), next: 0 }
    }

    /// The next command that is due before `tick` is stepped.
    pub(super) fn due(&mut self, tick: u64) -> Option<Command> {
        let scripted = self.commands.get(self.next).filter(|scripted| scripted.tick <= tick)?;
        self.next += 1;
        Some(scripted.command)
    }

    /// The commands that are still to come.
    pub(super) fn to_come(&self) -> impl Iterator<Item = Command> {
        self.commands[self.next..].iter().map(|scripted| scripted.command)
    }
}

/// What a script and a person can both work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Control {
    Method,
    TickRate,
    Throttle,
    Rudder,
}

impl Control {
    /// What a command works, if it is one of them.
    pub(super) fn of(command: Command) -> Option<Self> {
        match command {
            Command::Method(_)
            | Command::Pick(_)
            | Command::NextMethod
            | Command::PreviousMethod => Some(Control::Method),
            Command::TickHz(_) | Command::TickRateUp | Command::TickRateDown => {
                Some(Control::TickRate)
            }
            Command::Throttle(_) | Command::ThrottleUp | Command::ThrottleDown => {
                Some(Control::Throttle)
            }
            Command::Rudder(_) | Command::RudderLeft | Command::RudderRight => {
                Some(Control::Rudder)
            }
            _ => None,
        }
    }

    /// Its name for people.
    pub(super) fn name(self) -> &'static str {
        match self {
            Control::Method => "method",
            Control::TickRate => "tick rate",
            Control::Throttle => "throttle",
            Control::Rudder => "rudder",
        }
    }
}
