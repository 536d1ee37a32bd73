//! A graphics driver and a C++ compiler: found, or installed where that is allowed.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::shell::{self, Failure, cargo, run};

/// Debian's software Vulkan driver (lavapipe) and the loader.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// Debian's C++ compiler: `subsurface compare` is built with FLIP, which is written in it.
const COMPILER: [&str; 1] = ["g++"];

/// Where Vulkan's loader looks for the description of a driver.
const DESCRIPTIONS: [&str; 4] = [
    "/usr/share/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
    "/etc/vulkan/icd.d",
    "/usr/local/etc/vulkan/icd.d",
];

/// How the command line is built.
#[derive(Clone, Copy)]
pub(crate) enum Build {
    /// With all commands, as the tests run it.
    Test,
    /// With those that draw pictures alone, optimized as far as a few pictures are worth: see `[profile.demo]`.
    Demo,
}

impl Build {
    /// The arguments for Cargo that build the program.
    ///
    /// Those for tests name a test of the program in the whole workspace: Cargo builds dependencies with the features
    /// that all packages it is asked for want, so that the program alone would have other dependencies than the tests.
    fn arguments(self) -> &'static [&'static str] {
        match self {
            Self::Test => &["test", "--workspace", "--test", "usage", "--no-run"],
            Self::Demo => {
                &["build", "--package", "subsurface-cli", "--profile", "demo", "--no-default-features"]
            }
        }
    }

    /// The folder below the target folder that the program is built into.
    fn folder(self) -> &'static str {
        match self {
            Self::Test => "debug",
            Self::Demo => "demo",
        }
    }

    /// Builds the program.
    pub(crate) fn run(self) -> Result<(), Failure> {
        run(cargo().args(self.arguments()))
    }

    /// The program, in the root.
    pub(crate) fn program(self) -> Command {
        let name = format!("subsurface{}", std::env::consts::EXE_SUFFIX);
        let mut command = Command::new(shell::target().join(self.folder()).join(name));
        command.current_dir(shell::root());
        command
    }
}

/// Finds a C++ compiler, or installs one.
pub(crate) fn ensure_compiler() -> Result<(), Failure> {
    let runs = |program: &str| {
        let mut command = Command::new(program);
        command.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    // Elsewhere Rust's own linker comes with one.
    if !cfg!(target_os = "linux") || std::env::var_os("CXX").is_some() || runs("c++") {
        return Ok(());
    }
    if !has_apt_get() {
        let help = "install one: on Fedora `dnf install gcc-c++`, on Arch `pacman -S gcc`";
        return Err(Failure(format!("no C++ compiler\n  = help: {help}")));
    }
    println!("No C++ compiler: installing {} …", COMPILER.join(" "));
    install(&COMPILER)
        .map_err(|why| Failure(format!("no C++ compiler ({why})\n  = help: apt-get install g++")))
}

/// Builds the command line and asks it for an adapter; installs a software driver if there is none.
pub(crate) fn ensure(build: Build) -> Result<(), Failure> {
    if let Build::Test = build {
        ensure_compiler()?;
    }
    // A Linux without any driver needs one for sure: then the download does not wait for the build.
    let installing = (cfg!(target_os = "linux") && has_apt_get() && !is_described()).then(|| {
        println!("No Vulkan driver: installing {} during the build …", PACKAGES.join(" "));
        std::thread::spawn(|| install(&PACKAGES))
    });
    let built = build.run();
    let installed = installing
        .map(|thread| thread.join().unwrap_or_else(|_| Err("the installation broke off".to_owned())));
    built?;
    if has_adapter(build) {
        return Ok(());
    }
    match installed {
        Some(result) => result.map_err(|why| Failure(remedy(&why)))?,
        None if has_apt_get() => {
            println!("No graphics adapter: installing {} …", PACKAGES.join(" "));
            install(&PACKAGES).map_err(|why| Failure(remedy(&why)))?;
        }
        None => return Err(Failure(remedy("this system has no apt-get"))),
    }
    if has_adapter(build) {
        Ok(())
    } else {
        Err(Failure(remedy("the packages are installed, but offer no adapter")))
    }
}

fn has_apt_get() -> bool {
    Path::new("/usr/bin/apt-get").exists()
}

/// True if a Vulkan driver is installed, whether it works or not.
fn is_described() -> bool {
    let is_named =
        ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].iter().any(|name| std::env::var_os(name).is_some());
    let has_file = |folder: &str| std::fs::read_dir(folder).is_ok_and(|mut files| files.next().is_some());
    is_named || DESCRIPTIONS.iter().any(|folder| has_file(folder))
}

/// True if `subsurface adapter` finds one.
fn has_adapter(build: Build) -> bool {
    build.program().arg("adapter").status().is_ok_and(|status| status.success())
}

/// Installs packages; why not, if not.
fn install(packages: &[&str]) -> Result<(), String> {
    for arguments in [&["update"][..], &["install", "--yes", "--no-install-recommends"]] {
        let packages = if arguments[0] == "install" { packages } else { &[] };
        let mut command = privileged("apt-get");
        command.env("DEBIAN_FRONTEND", "noninteractive").args(arguments).args(packages).stdout(Stdio::null());
        run(&mut command).map_err(|Failure(why)| why)?;
    }
    Ok(())
}

/// `program` with the rights to install: as it is for root, through `sudo` (which must not ask) for others.
fn privileged(program: &str) -> Command {
    let id = Command::new("id").arg("-u").output();
    if id.is_ok_and(|output| output.stdout.trim_ascii() == b"0") {
        return Command::new(program);
    }
    let mut command = Command::new("sudo");
    command.args(["--non-interactive", program]);
    command
}

fn remedy(why: &str) -> String {
    format!(
        "no graphics adapter ({why})\n  = help: install a Vulkan driver: on Debian and Ubuntu `apt-get install \
         {}`, on Fedora `dnf install mesa-vulkan-drivers`, on Arch `pacman -S vulkan-swrast`",
        PACKAGES.join(" ")
    )
}
