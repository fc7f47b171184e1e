//! stub
use super::Command;
use crate::sim::bodies::Kind;
use crate::sim::integrators::{METHODS, Method};
#[derive(Clone, Debug)]
pub struct Scene {
    pub name: String,
    pub title: String,
    pub about: String,
    pub hint: Option<String>,
    pub tick_hz: u32,
    pub seconds: f64,
    pub lanes: Vec<LaneSpec>,
    pub bodies: Vec<SceneBody>,
    pub script: Vec<Scripted>,
}
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSpec {
    pub method: &'static Method,
    pub substeps: u32,
}
#[derive(Clone, Debug)]
pub struct SceneBody {
    pub name: String,
    pub kind: &'static Kind,
    pub values: Vec<f64>,
}
#[derive(Clone, Debug)]
pub struct Scripted {
    pub tick: u64,
    pub command: Command,
}
pub struct BuiltIn {
    pub name: &'static str,
    pub text: &'static str,
}
pub static SCENES: &[BuiltIn] = &[
    BuiltIn { name: "harbour", text: "" },
    BuiltIn { name: "ship", text: "" },
    BuiltIn { name: "spring", text: "" },
    BuiltIn { name: "stiff", text: "" },
];
impl Scene {
    pub fn built_in(name: &str) -> Option<Scene> {
        use crate::sim::bodies::kind;
        let spring = |n: &str, k: f64, c: f64| SceneBody {
            name: n.into(),
            kind: kind("spring").unwrap(),
            values: vec![1.0, k, c, 1.0, 0.0, 3.0],
        };
        let ship = || SceneBody {
            name: "ship".into(),
            kind: kind("ship").unwrap(),
            values: vec![20000.0, 1000.0, 10000.0, 0.0, 0.0, 20000.0],
        };
        let k1 = 39.47841760435743;
        let (tick_hz, seconds, bodies) = match name {
            "harbour" => {
                (60, 20.0, vec![ship(), spring("buoy", k1, 0.0), spring("mooring", 20.0, 0.4)])
            }
            "ship" => (2, 60.0, vec![ship()]),
            "spring" => (60, 20.0, vec![spring("spring", k1, 0.0)]),
            "stiff" => (60, 5.0, vec![spring("stiff", 1e4, 0.0)]),
            _ => return None,
        };
        Some(Scene {
            name: name.into(),
            title: "A title".into(),
            about: "about".into(),
            hint: Some(
                "press 1 for explicit Euler and watch the amplitude; C races all methods".into(),
            ),
            tick_hz,
            seconds,
            lanes: METHODS.iter().map(|method| LaneSpec { method, substeps: 1 }).collect(),
            bodies,
            script: vec![],
        })
    }
}
