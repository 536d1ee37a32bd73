//! The numbers that Rust and WGSL share, as WGSL files.

use std::fmt::Write as _;
use std::sync::LazyLock;

use subsurface_kernel::{ConstantValue, DebugView, constants};
use subsurface_profile::SHARED_CONSTANTS;
use subsurface_shaders::Module;

static OF_KERNELS: LazyLock<String> = LazyLock::new(text_of_kernels);
static OF_PROFILES: LazyLock<String> = LazyLock::new(text_of_profiles);

/// Constants of the contract, and coefficients of the profiles' formulas, under the names that headers use; the linker
/// keeps those that a module takes.
pub(crate) fn shared_constants() -> [Module; 2] {
    [
        Module { name: "kernel/constants", text: OF_KERNELS.as_str() },
        Module { name: "profile/constants", text: OF_PROFILES.as_str() },
    ]
}

fn text_of_profiles() -> String {
    let mut text = String::new();
    for constant in SHARED_CONSTANTS {
        let values: Vec<String> = constant.values.iter().copied().map(number).collect();
        let ty = format!("vec{}f", values.len());
        let (docs, name) = (constant.docs, constant.name);
        let _ = writeln!(text, "/// {docs}\nconst {name}: {ty} = {ty}({});\n", values.join(", "));
    }
    text
}

fn text_of_kernels() -> String {
    let mut text = String::new();
    for constant in constants::ALL {
        for line in constant.docs {
            let _ = writeln!(text, "///{line}");
        }
        let (ty, value) = match constant.value {
            ConstantValue::F32(value) => ("f32", number(value)),
            ConstantValue::I32(value) => ("i32", value.to_string()),
            ConstantValue::U32(value) => ("u32", format!("{value}u")),
            ConstantValue::Vec2(values) => ("vec2f", format!("vec2f({})", values.map(number).join(", "))),
            ConstantValue::Vec3(values) => ("vec3f", format!("vec3f({})", values.map(number).join(", "))),
            // A new type of the contract has to be spelled here before a shader can use it.
            _ => continue,
        };
        let _ = writeln!(text, "const {}: {ty} = {value};\n", constant.name);
    }
    for view in DebugView::ALL {
        let (name, number) = (view.constant(), view.number());
        let _ = writeln!(
            text,
            "/// Number of the debug view `{}`.\nconst {name}: u32 = {number}u;\n",
            view.name()
        );
    }
    text
}

/// The shortest decimal that is the nearest `f32`.
fn number(value: f64) -> String {
    format!("{:?}", crate::value::single(value))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::item::items;

    #[test]
    fn every_constant_is_declared_with_its_value() {
        let text = text_of_kernels();
        for line in [
            "const FILTER_QUANTILE: f32 = 0.997;",
            "const LARGEST_TAP_COUNT: u32 = 4096u;",
            "const BLOCK_SIDE: i32 = 2;",
            "const EVEN_WINDOW: vec3f = vec3f(0.125, 0.5, 0.375);",
            "const DEBUG_TAPS: u32 = 1u;",
        ] {
            assert!(text.contains(line), "{line}\n{text}");
        }
        assert!(text.contains("/// ½ log₃ 2\n"));
        let declared = items(&text).unwrap().items.len();
        assert_eq!(declared, constants::ALL.len() + DebugView::ALL.len());
        for file in shared_constants() {
            naga::front::wgsl::parse_str(file.text).unwrap();
            assert!(file.text.lines().all(|line| line.chars().count() <= 120), "{}", file.text);
        }
    }

    #[test]
    fn every_constant_is_used_by_a_shader() {
        use subsurface_shaders::{GATHER, KERNELS, LIBRARY, LIGHT, PASSES, PROFILES};
        let [kernels, profiles] = shared_constants();
        for item in [kernels, profiles].iter().flat_map(|file| items(file.text).unwrap().items) {
            let mut house = [LIBRARY, GATHER, KERNELS, LIGHT, PROFILES, PASSES].into_iter().flatten();
            let uses = |module: &Module| {
                items(module.text).unwrap().items.iter().any(|other| other.references.contains(item.name))
            };
            let is_used = house.any(uses);
            assert!(is_used, "no shader uses {}: it is no constant of two languages", item.name);
        }
    }
}
