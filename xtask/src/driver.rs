//! A graphics driver: found, or installed where that is allowed.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::shell::{Failure, cargo, run};

/// Debian's software Vulkan driver (lavapipe) and the loader.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// Builds the command line and asks it for an adapter; installs a software driver if there is none.
pub(crate) fn ensure(profile: &str) -> Result<(), Failure> {
    run(cargo().args(["build", "--package", "subsurface-cli", "--profile", profile]))?;
    if has_adapter(profile) {
        return Ok(());
    }
    if !Path::new("/usr/bin/apt-get").exists() {
        return Err(Failure(remedy("this system has no apt-get")));
    }
    println!("No graphics adapter: installing {} …", PACKAGES.join(" "));
    install()?;
    if has_adapter(profile) {
        Ok(())
    } else {
        Err(Failure(remedy("the packages are installed, but offer no adapter")))
    }
}

/// True if `subsurface adapter` finds one.
fn has_adapter(profile: &str) -> bool {
    let mut command = cargo();
    command.args(["run", "--quiet", "--package", "subsurface-cli", "--profile", profile, "--", "adapter"]);
    command.status().is_ok_and(|status| status.success())
}

fn install() -> Result<(), Failure> {
    for arguments in [&["update"][..], &["install", "--yes", "--no-install-recommends"]] {
        let packages: &[&str] = if arguments[0] == "install" { &PACKAGES } else { &[] };
        let mut command = privileged("apt-get");
        command.env("DEBIAN_FRONTEND", "noninteractive").args(arguments).args(packages).stdout(Stdio::null());
        run(&mut command).map_err(|Failure(why)| Failure(remedy(&why)))?;
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
