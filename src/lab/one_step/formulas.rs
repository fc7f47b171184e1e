//! The formulas of the methods, for people: `f(t, y) = (v, a(t, q, v))` on the state `y = (q, v)`.

/// How a method is written.
#[derive(Clone, Copy, Debug)]
pub struct Formula {
    /// The id of the method.
    pub method: &'static str,
    /// The formula, line by line, with ′ on what holds at the end of the step.
    pub lines: &'static [&'static str],
    /// The weights of the evaluations in `y′ = y + h Σ w k`; empty if the method is no such sum.
    pub weights: &'static [f64],
}

const fn formula(
    method: &'static str,
    lines: &'static [&'static str],
    weights: &'static [f64],
) -> Formula {
    Formula { method, lines, weights }
}

/// The formula of each method.
pub const FORMULAS: &[Formula] = &[
    formula("explicit-euler", &["y′ = y + h f(t, y)"], &[1.0]),
    formula(
        "midpoint",
        &["k₁ = f(t, y)", "k₂ = f(t + ½h, y + ½h k₁)", "y′ = y + h k₂"],
        &[0.0, 1.0],
    ),
    formula(
        "improved-euler",
        &["k₁ = f(t, y)", "k₂ = f(t + h, y + h k₁)", "y′ = y + ½h (k₁ + k₂)"],
        &[0.5, 0.5],
    ),
    formula(
        "ssp-rk3",
        &[
            "k₁ = f(t, y)",
            "k₂ = f(t + h, y + h k₁)",
            "k₃ = f(t + ½h, y + ¼h (k₁ + k₂))",
            "y′ = y + h (k₁ + k₂ + 4 k₃) / 6",
        ],
        &[1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
    ),
    formula(
        "rk4",
        &[
            "k₁ = f(t, y)",
            "k₂ = f(t + ½h, y + ½h k₁)",
            "k₃ = f(t + ½h, y + ½h k₂)",
            "k₄ = f(t + h, y + h k₃)",
            "y′ = y + h (k₁ + 2 k₂ + 2 k₃ + k₄) / 6",
        ],
        &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    ),
    formula("adams-bashforth-2", &["f = f(t, y), g = f(t − h, y₋₁)", "y′ = y + ½h (3 f − g)"], &[]),
    formula("semi-implicit-euler", &["v′ = v + h a(t, q, v)", "q′ = q + h v′"], &[]),
    formula(
        "velocity-verlet",
        &["v½ = v + ½h a", "q′ = q + h v½", "a′ = a(t + h, q′, v½ + ½h a)", "v′ = v½ + ½h a′"],
        &[],
    ),
    formula(
        "position-verlet",
        &["q½ = q + ½h v", "v′ = v + h a(t + ½h, q½, v)", "q′ = q½ + ½h v′"],
        &[],
    ),
    formula("stormer-verlet", &["q′ = 2 q − q₋₁ + h² a", "v′ = (q′ − q) / h + ½h a′"], &[]),
    formula(
        "yoshida4",
        &[
            "drifts of θ/2, (1−θ)/2, (1−θ)/2, θ/2",
            "between them kicks of θ, 1−2θ, θ",
            "θ = 1 / (2 − ∛2)",
        ],
        &[],
    ),
    formula(
        "pefrl",
        &[
            "drifts of ξ, χ, 1−2(χ+ξ), χ, ξ",
            "between them kicks of (1−2λ)/2, λ, λ, (1−2λ)/2",
            "ξ = 0.1786, λ = −0.2123, χ = −0.0663",
        ],
        &[],
    ),
    formula(
        "adaptive-euler",
        &[
            "k₁ = f(t, y), k₂ = f(t + ½h, y + ½h k₁)",
            "error = ½h |k₁ − k₂|",
            "y′ = y + h k₂ if the error is small",
        ],
        &[],
    ),
    formula(
        "bogacki-shampine-32",
        &[
            "k₂ = f(t + ½h, y + ½h k₁)",
            "k₃ = f(t + ¾h, y + ¾h k₂)",
            "y′ = y + h (2 k₁ + 3 k₂ + 4 k₃) / 9",
            "k₄ = f(t + h, y′), for the error",
        ],
        &[],
    ),
    formula(
        "dormand-prince-54",
        &[
            "kᵢ = f(t + cᵢ h, y + h Σ aᵢⱼ kⱼ), i = 1 … 7",
            "y′ = y + h Σ a₇ⱼ kⱼ",
            "error = h Σ eᵢ kᵢ",
        ],
        &[],
    ),
    formula("implicit-euler", &["y′ = y + h f(t + h, y′)"], &[]),
    formula("implicit-midpoint", &["m = y + ½h f(t + ½h, m)", "y′ = 2 m − y"], &[]),
    formula(
        "newmark",
        &["q′ = q + h v + ¼h² (a + a′)", "v′ = v + ½h (a + a′)", "a′ = a(t + h, q′, v′)"],
        &[],
    ),
    formula("bdf2", &["y′ = y + ⅓ (y − y₋₁) + ⅔h f(t + h, y′)"], &[]),
    formula(
        "gauss-legendre-4",
        &["Yᵢ = y + h Σ aᵢⱼ f(t + cᵢ h, Yⱼ)", "y′ = y + ½h (f(Y₁) + f(Y₂))"],
        &[],
    ),
    formula(
        "tr-bdf2",
        &[
            "Y = y + ½γh (f(t, y) + f(t + γ h, Y)), γ = 2 − √2",
            "y′ = y + 1.207 (Y − y) + ½γh f(t + h, y′)",
        ],
        &[],
    ),
    formula("linearly-implicit-euler", &["(I − h ∂f/∂y) (y′ − y) = h f(t + h, y)"], &[]),
    formula(
        "semi-implicit-euler-implicit-drag",
        &["(I − h ∂a/∂v) (v′ − v) = h a(t, q, v)", "q′ = q + h v′"],
        &[],
    ),
    formula(
        "verlet-exact-drag",
        &[
            "v₁ = exp(½h D) v, D = ∂a/∂v",
            "a Verlet step of a − D v, from v₁ to v₂",
            "v′ = exp(½h D) v₂",
        ],
        &[],
    ),
    formula(
        "exponential-rosenbrock-euler",
        &[
            "y′ = y + h φ₁(h J) f(t, y) + h² φ₂(h J) fₜ",
            "J = ∂f/∂y, fₜ = (f(t + h, y) − f(t, y)) / h",
            "φ₁(z) = (exp(z) − 1) / z, φ₂(z) = (φ₁(z) − 1) / z",
        ],
        &[],
    ),
    formula(
        "improved-euler-as-printed",
        &["k₁ = a(t, q, v), k₂ = a(t + h, q, v + h k₁)", "v′ = v + ½h (k₁ + k₂)", "q′ = q + h v′"],
        &[],
    ),
    formula(
        "rk4-as-printed",
        &[
            "k₁ … k₄ of the velocity alone, at q",
            "v′ = v + h (k₁ + 2 k₂ + 2 k₃ + k₄) / 6",
            "q′ = q + h v′",
        ],
        &[],
    ),
    formula(
        "adaptive-euler-as-printed",
        &["e = |v₁ − v₂|, of one step and of two halves", "h shrinks to h √(tolerance / e)"],
        &[],
    ),
    formula("jakobsen-verlet", &["q′ = q + 0.99 (q − q₋₁) + h² a", "v′ = (q′ − q) / h"], &[]),
    formula("lerp-per-frame", &["x′ = x + 0.1 (g − x), whatever h is", "v′ = k (g − x′)"], &[]),
    formula("lerp-dt", &["x′ = x + k h (g − x)", "v′ = k (g − x′)"], &[]),
    formula("exponential-decay", &["x′ = g + (x − g) exp(−k h)", "v′ = k (g − x′)"], &[]),
    formula(
        "smooth-damp",
        &[
            "e = 1 / (1 + z + 0.48 z² + 0.235 z³), z = ω h",
            "b = (v + ω (x − g)) h",
            "x′ = g + (x − g + b) e, but not beyond g",
            "v′ = (v − ω b) e",
        ],
        &[],
    ),
    formula(
        "critically-damped-spring",
        &["b = (v + ω (x − g)) h", "x′ = g + (x − g + b) exp(−ω h)", "v′ = (v − ω b) exp(−ω h)"],
        &[],
    ),
    formula("implicit-spring", &["v′ = (v + h ω² (g − x)) / (1 + ω h)²", "x′ = x + h v′"], &[]),
    formula(
        "engine-box2d",
        &[
            "n times: p = v / (1 + h C) + h f",
            "v = (p − h K x) / D, x = x + h v",
            "v = (p − h K x) / D, D = 1 + h c + h² K",
        ],
        &[],
    ),
    formula(
        "engine-rapier",
        &[
            "n times: v = (v + h f − h K x) / D",
            "x = x + h v, D = 1 + h c + h² K",
            "then once: v = v / (1 + H C)",
        ],
        &[],
    ),
    formula(
        "engine-avian",
        &[
            "n times: v = v / (1 + h C) + h f, x = x + h v",
            "d = −x h² K / (1 + h² K), x = x + d",
            "v = (v + d / h) (1 − h c)",
        ],
        &[],
    ),
    formula(
        "engine-avian-motor",
        &[
            "n times: v = v / (1 + h C) + h f, x = x + h v",
            "the first time v + Σ d₋₁ before x",
            "d = −h² (K x + c v) / D, x = x + d, v = v + d / h",
        ],
        &[],
    ),
    formula(
        "engine-jolt",
        &[
            "n times: v = (v + h f) (1 − h C)",
            "v = (v − h K x) / D, x = x + h v",
            "D = 1 + h c + h² K",
        ],
        &[],
    ),
    formula(
        "engine-physx",
        &["v = (v + H f) (1 − H C)", "v′ = (v − H K x) / D, x′ = x + H v′", "D = 1 + H c + H² K"],
        &[],
    ),
    formula(
        "engine-physx-tgs",
        &[
            "v = (v + H f) (1 − H C), d = 0",
            "n times: v = (v − h K (x + d)) / D − E h c d",
            "d = d + h v",
            "x′ = x + d, v′ = v / D, E = 1 / (1 + h² (c + K))",
        ],
        &[],
    ),
    formula(
        "engine-bullet",
        &[
            "n times: v = v e^(−C h)",
            "g = −h (K x + c v), K ≤ 1 / (16 h²), c ≤ 1 / h",
            "if f ≠ 0: g = g − h f between 0, g and −h c v",
            "v = v + g + h f, x = x + h v",
        ],
        &[],
    ),
    formula(
        "engine-pybullet",
        &["d = 1 − e^(−C)", "v′ = v + H (f − d v (1 + |v|))", "x′ = x + H v′"],
        &[],
    ),
    formula(
        "engine-chipmunk",
        &["x′ = x + H v", "v′ = ((v − H K x′) e^(−C H) + H f) e^(−c H)"],
        &[],
    ),
    formula(
        "engine-mujoco",
        &["n times: v = (v + h (f − K x)) / (1 + h (c + C))", "x = x + h v"],
        &[],
    ),
    formula(
        "engine-mujoco-rk4",
        &["f = held for the tick", "n times: rk4 on a = f − K x − (c + C) v"],
        &[],
    ),
    formula(
        "engine-godot",
        &["v = v (1 − H C) + H f − H K x", "v′ = v e^(−8 c H), x′ = x + H v′"],
        &[],
    ),
    formula("held-force", &["f = a(t, x, v), once", "n times: v = v + h f, x = x + h v"], &[]),
];
