//! The steps of the gate, in the order in which they run.

use super::step::{Outcome, Step};
use crate::shell::{Failure, cargo, run};
use crate::tool::{self, Found};
use crate::toolchain;
use crate::{page, shader_cost, tables, test};

/// What every change passes before it is merged.
pub(crate) const ALL: [Step; 14] = [
    FORMATTING,
    SPELLING,
    DEPENDENCIES,
    LINTS,
    LINTS_OF_THE_DEMO,
    DOCUMENTATION,
    TESTS,
    TESTS_WITH_WGPU_29,
    ACCURACY,
    TABLES,
    SHADER_COST,
    Step { title: "oldest Rust", what: "cargo +1.88 check --workspace --all-targets", run: oldest_rust },
    Step { title: "packages", what: "cargo package --workspace", run: packages },
    Step { title: "semantic versions", what: "cargo semver-checks", run: semantic_versions },
];

/// What a change passes between two edits.
pub(crate) const QUICK: [Step; 3] = [
    FORMATTING,
    LINTS,
    Step { title: "unit tests", what: "cargo test --workspace --lib --bins", run: unit_tests },
];

const FORMATTING: Step = Step {
    title: "formatting",
    what: "cargo fmt --all --check",
    run: || passes(&["fmt", "--all", "--check"]),
};

const SPELLING: Step = Step { title: "spelling", what: "typos", run: spelling };

const DEPENDENCIES: Step =
    Step { title: "dependencies", what: "cargo deny check bans licenses sources", run: dependencies };

const LINTS: Step = Step {
    title: "lints",
    what: "cargo clippy --workspace --all-targets -- -D warnings",
    run: || passes(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]),
};

const LINTS_OF_THE_DEMO: Step = Step {
    title: "lints of the demo",
    what: "cargo clippy --package subsurface-cli --no-default-features -- -D warnings",
    run: || {
        passes(&["clippy", "--package", "subsurface-cli", "--no-default-features", "--", "-D", "warnings"])
    },
};

const DOCUMENTATION: Step = Step {
    title: "documentation",
    what: "RUSTDOCFLAGS=\"-D warnings\" cargo doc --workspace --no-deps",
    run: documentation,
};

const TESTS: Step = Step { title: "tests", what: "cargo xtask test", run: tests };

/// The workspace is built against wgpu 30. What differs with 29 is in two places of the runtime, and the four passes
/// together go through both.
const TESTS_WITH_WGPU_29: Step = Step {
    title: "tests with wgpu 29",
    what: "cargo test --package subsurface-runtime --no-default-features --features wgpu-29,vulkan --test renderer",
    run: || {
        passes(&[
            "test",
            "--package",
            "subsurface-runtime",
            "--no-default-features",
            "--features",
            "wgpu-29,vulkan",
            "--test",
            "renderer",
        ])
    },
};

const ACCURACY: Step =
    Step { title: "accuracy", what: "cargo xtask accuracy --check", run: accuracy_is_current };

const TABLES: Step = Step { title: "tables", what: "cargo xtask tables --check", run: tables_are_current };

const SHADER_COST: Step =
    Step { title: "shader cost", what: "cargo xtask shader-cost --check", run: shader_cost_is_current };

fn passes(arguments: &[&str]) -> Result<Outcome, Failure> {
    run(cargo().args(arguments))?;
    Ok(Outcome::Passed)
}

fn spelling() -> Result<Outcome, Failure> {
    match tool::find(&tool::TYPOS) {
        Found::At(program) => {
            run(&mut std::process::Command::new(program))?;
            Ok(Outcome::Passed)
        }
        Found::Not(why) => Ok(Outcome::NotRun(why)),
    }
}

/// Bans, licences and sources are decided by `deny.toml` and `Cargo.lock` alone. The advisories are a database on the
/// network, so that the same commit could pass today and fail tomorrow.
fn dependencies() -> Result<Outcome, Failure> {
    match tool::find(&tool::CARGO_DENY) {
        Found::At(program) => {
            let mut command = std::process::Command::new(program);
            run(command.args(["--log-level", "error", "check", "bans", "licenses", "sources"]))?;
            Ok(Outcome::PassedExcept(
                "advisories, whose database is on the network (`cargo deny check advisories`)".to_owned(),
            ))
        }
        Found::Not(why) => Ok(Outcome::NotRun(why)),
    }
}

fn documentation() -> Result<Outcome, Failure> {
    run(cargo().env("RUSTDOCFLAGS", "-D warnings").args(["doc", "--workspace", "--no-deps"]))?;
    Ok(Outcome::Passed)
}

fn tests() -> Result<Outcome, Failure> {
    test(&[])?;
    Ok(Outcome::Passed)
}

fn unit_tests() -> Result<Outcome, Failure> {
    passes(&["test", "--workspace", "--lib", "--bins"])
}

fn accuracy_is_current() -> Result<Outcome, Failure> {
    page::ACCURACY.run_command(&["--check".to_owned()])?;
    Ok(Outcome::Passed)
}

fn tables_are_current() -> Result<Outcome, Failure> {
    tables::run_command(&["--check".to_owned()])?;
    Ok(Outcome::Passed)
}

fn shader_cost_is_current() -> Result<Outcome, Failure> {
    if shader_cost::check()? {
        return Ok(Outcome::Passed);
    }
    Ok(Outcome::NotRun("RADV is not here in the version whose figures were accepted: see above".to_owned()))
}

fn oldest_rust() -> Result<Outcome, Failure> {
    let version = toolchain::oldest()?;
    let Some(mut cargo) = toolchain::cargo(&version) else {
        return Ok(Outcome::NotRun(format!(
            "the toolchain {version} is not installed (`rustup toolchain install {version} --profile minimal`)"
        )));
    };
    run(cargo.args(["check", "--workspace", "--all-targets"]))?;
    Ok(Outcome::Passed)
}

/// Packing builds every crate once more from its package: nine minutes on two cores.
fn packages() -> Result<Outcome, Failure> {
    let command = "cargo package --workspace --exclude xtask";
    Ok(Outcome::NotRun(format!(
        "it builds every crate once more, which takes minutes; before a release run `{command}`"
    )))
}

fn semantic_versions() -> Result<Outcome, Failure> {
    Ok(Outcome::NotRun("no crate is published yet, so there is no version to compare with".to_owned()))
}
