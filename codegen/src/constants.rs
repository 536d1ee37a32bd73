//! The numbers that Rust and WGSL share, as a WGSL file.

use std::fmt::Write as _;
use std::sync::LazyLock;

use subsurface_kernel::{ConstantValue, DebugView, constants};
use subsurface_shaders::Module;

/// Name under which a header names the file.
const NAME: &str = "kernel/constants";

static TEXT: LazyLock<String> = LazyLock::new(text);

/// All constants of the contract; the linker keeps those that a module uses.
pub(crate) fn shared_constants() -> Module {
    Module { name: NAME, text: TEXT.as_str() }
}

fn text() -> String {
    let mut text = String::new();
    for constant in constants::ALL {
        for line in constant.docs {
            let _ = writeln!(text, "///{line}");
        }
        let (ty, value) = match constant.value {
            ConstantValue::F32(value) => ("f32", number(value)),
            ConstantValue::I32(value) => ("i32", value.to_string()),
            ConstantValue::U32(value) => ("u32", format!("{value}u")),
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
        let text = text();
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
        naga::front::wgsl::parse_str(&text).unwrap();
    }

    #[test]
    fn every_constant_is_used_by_a_shader() {
        use subsurface_shaders::{GATHER, KERNELS, LIBRARY, LIGHT, PASSES, PROFILES};
        for item in items(&text()).unwrap().items {
            let mut house = [LIBRARY, GATHER, KERNELS, LIGHT, PROFILES, PASSES].into_iter().flatten();
            let uses = |module: &Module| {
                items(module.text).unwrap().items.iter().any(|other| other.references.contains(item.name))
            };
            let is_used = house.any(uses);
            assert!(is_used, "no shader uses {}: it is no constant of two languages", item.name);
        }
    }
}
