//! The bits of the foreign code behind the physics: `libm` and `glam`.
//!
//! The bits are promised for the versions in `Cargo.lock`. A game may have later patches, with bits of their own.
//! If one of these hashes changes, so do states, and hashes that users have committed.

use glam::{DVec2, DVec3};
use regatta::run::Race;
use regatta::scene::Scene;

/// 64-bit FNV-1a over little-endian words. All NaNs count as one.
struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn value(&mut self, value: f64) {
        let bits = if value.is_nan() { u64::MAX } else { value.to_bits() };
        for byte in bits.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// Zeros, subnormal and huge numbers, both infinities and no number; then numbers of every magnitude, and
/// such as physics meets.
fn inputs() -> Vec<f64> {
    let extremes = [0.0, 5e-324, 1e-310, f64::MIN_POSITIVE, 1e300, f64::MAX, f64::INFINITY];
    let mut inputs: Vec<f64> = extremes.into_iter().flat_map(|x| [x, -x]).collect();
    inputs.push(f64::NAN);
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    for n in 0..20_000 {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        let plain = (random >> 11) as f64 / (1_u64 << 53) as f64;
        inputs.push(match n % 4 {
            0 => f64::from_bits(random),
            1 => 2.0 * plain - 1.0,
            2 => 100.0 * (2.0 * plain - 1.0),
            _ => 1e6 * (2.0 * plain - 1.0),
        });
    }
    inputs
}

fn hash_of(function: impl Fn(f64) -> f64) -> u64 {
    let mut hash = Fnv::new();
    inputs().into_iter().for_each(|x| hash.value(function(x)));
    hash.0
}

/// The hash over neighbours in the list of inputs.
fn hash_of_two(function: impl Fn(f64, f64) -> f64) -> u64 {
    let mut hash = Fnv::new();
    inputs().windows(2).for_each(|pair| hash.value(function(pair[0], pair[1])));
    hash.0
}

fn assert_hashes(found: &[(&str, u64)], kept: &[(&str, u64)]) {
    let lines = |hashes: &[(&str, u64)]| -> String {
        hashes.iter().map(|(name, hash)| format!("(\"{name}\", {hash:#018x}),\n")).collect()
    };
    assert!(found == kept, "found:\n{}kept:\n{}", lines(found), lines(kept));
}

#[test]
fn the_functions_of_libm_keep_their_bits() {
    let exponent = |x: f64| ((x.abs() % 4000.0) as i32) - 2000;
    let found = [
        ("asinh", hash_of(libm::asinh)),
        ("atan2", hash_of_two(libm::atan2)),
        ("cos", hash_of(libm::cos)),
        ("exp", hash_of(libm::exp)),
        ("expm1", hash_of(libm::expm1)),
        ("hypot", hash_of_two(libm::hypot)),
        ("ilogb", hash_of(|x| f64::from(libm::ilogb(x)))),
        ("log", hash_of(libm::log)),
        ("log2", hash_of(libm::log2)),
        ("pow", hash_of_two(libm::pow)),
        ("remainder", hash_of_two(libm::remainder)),
        ("rint", hash_of(libm::rint)),
        ("scalbn", hash_of_two(|x, y| libm::scalbn(x, exponent(y)))),
        ("sin", hash_of(libm::sin)),
        ("sinh", hash_of(libm::sinh)),
    ];
    let kept = [
        ("asinh", 0x0cff_dabf_3404_55eb),
        ("atan2", 0x132f_7ff9_80da_6ecf),
        ("cos", 0xaee2_8c7c_1f18_4bb3),
        ("exp", 0xe36a_e527_8fe2_5e37),
        ("expm1", 0xca1e_1f84_550b_841d),
        ("hypot", 0xbb02_c269_ed2d_a85f),
        ("ilogb", 0xa03f_18ee_348c_f98c),
        ("log", 0x8358_a0ba_df48_0f9d),
        ("log2", 0xd9a1_aef9_3dc4_73bc),
        ("pow", 0xfb02_a171_2e1f_e515),
        ("remainder", 0x9d7f_fb50_9e95_e208),
        ("rint", 0x1ca2_3a75_acdd_c6a5),
        ("scalbn", 0x070e_43b5_46b5_de35),
        ("sin", 0x7c0a_45fa_75c3_07f4),
        ("sinh", 0x704a_2c47_8246_fcf1),
    ];
    assert_hashes(&found, &kept);
}

#[test]
fn the_vectors_of_glam_keep_their_bits() {
    let planes: Vec<DVec2> = inputs().windows(2).map(|xy| DVec2::new(xy[0], xy[1])).collect();
    let spaces: Vec<DVec3> =
        inputs().windows(3).map(|xyz| DVec3::new(xyz[0], xyz[1], xyz[2])).collect();
    let plane = |function: fn(DVec2, DVec2) -> DVec2| {
        let mut hash = Fnv::new();
        for pair in planes.windows(2) {
            function(pair[0], pair[1]).to_array().into_iter().for_each(|x| hash.value(x));
        }
        hash.0
    };
    let space = |function: fn(DVec3, DVec3) -> DVec3| {
        let mut hash = Fnv::new();
        for pair in spaces.windows(2) {
            function(pair[0], pair[1]).to_array().into_iter().for_each(|x| hash.value(x));
        }
        hash.0
    };
    let found = [
        ("sum", plane(|a, b| a + b)),
        ("scaled", plane(|a, b| a + b.x * b)),
        ("quotient", plane(|a, b| a / b.y)),
        ("products", plane(|a, b| DVec2::new(a.dot(b), a.perp_dot(b)))),
        ("lengths", plane(|a, b| DVec2::new(a.length(), b.length_squared()))),
        ("perp", plane(|a, b| a.perp() - b)),
        ("direction", plane(|a, _| a.normalize_or_zero())),
        ("turned", plane(|a, b| a.rotate(b))),
        ("largest", plane(|a, b| DVec2::new(a.max_element(), b.abs().max_element()))),
        ("sum of three", space(|a, b| a + b.x * b)),
        ("parts", space(|a, b| (a.truncate() / b.z).extend(b.x))),
    ];
    let kept = [
        ("sum", 0xa1bd_29b4_984d_7993),
        ("scaled", 0x0c52_b93b_0b3c_c9dd),
        ("quotient", 0xd93b_84b6_49ec_b2d7),
        ("products", 0xc08d_bba7_a418_c0a7),
        ("lengths", 0xbe25_27a5_982f_c4c0),
        ("perp", 0x7f73_6273_79ba_0e09),
        ("direction", 0x52cf_cb67_dd7f_305d),
        ("turned", 0x8092_f9b9_7558_f9ae),
        ("largest", 0xf6df_bfbb_7590_4326),
        ("sum of three", 0x12b0_25eb_a080_f6d3),
        ("parts", 0x1822_c323_64ce_655d),
    ];
    assert_hashes(&found, &kept);
}

#[test]
fn the_manual_names_the_glam_and_libm_versions_with_promised_bits() {
    let manifest = include_str!("../../Cargo.toml");
    let lock = include_str!("../../Cargo.lock");
    let chapter = regatta::manual::chapter("stable").expect("a chapter").text;
    for (name, version) in [("glam", "0.34.3"), ("libm", "0.2.16")] {
        let of_name = |line: &'static str| line.strip_prefix(name)?.strip_prefix(" = ");
        let asked = manifest.lines().find_map(of_name).expect("a dependency");
        let asked = asked.trim_start_matches("{ version = ").trim_start_matches('"');
        assert!(asked.starts_with(|c: char| c.is_ascii_digit()), "{name} is asked for as {asked}");
        assert!(lock.contains(&format!("name = \"{name}\"\nversion = \"{version}\"")), "{name}");
        assert!(chapter.contains(&format!("`{name}` {version}")), "{name}");
    }
}

#[test]
fn the_hashes_in_the_manual_are_right() {
    let chapter = regatta::manual::chapter("stable").expect("a chapter").text;
    for scene in ["pendulum", "orbit", "helm"] {
        let mut race = Race::of_scene(&Scene::built_in(scene).expect("a built-in scene"));
        race.run(600);
        let hash = race.state_hash();
        assert!(chapter.contains(&format!("{scene} {hash:016x}")), "{scene} {hash:016x}");
    }
}
