//! Other systems on this one: wine for Windows, QEMU for arm64, an emulator of the processors for macOS; and the C
//! compiler for their programs.

use super::debian::{Packages, packages};
use super::hosts::{Host, Loading, compile, folder, folder_of_hosts};
use super::python::{environment_of, python, site_packages_file, target_folder};
use std::fs::File;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{fs, io};

/// A system that runs the libraries of one platform.
pub struct System {
    /// Folder of the platform in an FMU.
    pub platform: &'static str,
    /// Its name and version.
    pub name: String,
    pub host: Host,
}

/// The interpreter with the packages for other systems, beside which CMake is.
///
/// # Errors
/// The reason why they can't be installed.
pub fn tools() -> Result<PathBuf, String> {
    environment_of("platforms-venv", &folder().join("requirements.txt"))
}

/// The compiler for `target`.
fn compiler(target: &str) -> Result<Vec<PathBuf>, String> {
    let cache = format!("ZIG_GLOBAL_CACHE_DIR={}", target_folder().join("zig").display());
    let mut compiler = vec!["env".into(), cache.into(), tools()?];
    compiler.extend(["-m", "ziglang", "cc", "-target", target].map(PathBuf::from));
    Ok(compiler)
}

/// A call of the C compiler for `target`.
///
/// # Errors
/// The reason why it is not available.
pub fn compile_for(target: &str) -> Result<Command, String> {
    let compiler = compiler(target)?;
    let mut command = Command::new(&compiler[0]);
    command.args(&compiler[1..]);
    Ok(command)
}

/// The host in tests/platforms, compiled for `target`.
fn compiled(target: &str, ending: &str) -> Result<PathBuf, String> {
    let compiler = compiler(target)?;
    compile(&format!("host-{target}{ending}"), "host.c", Loading::BySystem, &compiler, &[])
}

/// Windows, through wine.
///
/// # Errors
/// The reason why it is not available.
pub fn windows() -> Result<System, String> {
    let (wine, version) = wine()?;
    let program = compiled("x86_64-windows-gnu", ".exe")?;
    let host = Host { command: vec![wine, program], variables: Vec::new() };
    Ok(System { platform: "win64", name: format!("wine {version}"), host })
}

/// The program that starts wine, and wine's version.
///
/// # Errors
/// The reason why it is not available.
pub fn wine() -> Result<(PathBuf, String), String> {
    let Packages { folder, versions } = packages("wine", "bookworm", &["wine64"], true)?;
    let version = version_of(&versions, "wine64")?.to_string();
    let wine = prepare_wine(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok((wine, version))
}

/// Does the work of the installation scripts of wine's packages, and adds a program that starts wine from its
/// unpacked folder.
fn prepare_wine(folder: &Path) -> io::Result<PathBuf> {
    let programs = folder.join("programs");
    let start = programs.join("wine64");
    fs::create_dir_all(&programs)?;
    // user32.dll needs a zlib1.dll that is marked as part of wine
    let mut zlib = fs::read(folder.join("usr/x86_64-w64-mingw32/lib/zlib1.dll"))?;
    let mark = b"Wine builtin DLL\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
    zlib[64..96].copy_from_slice(mark);
    fs::write(folder.join("usr/lib/x86_64-linux-gnu/wine/x86_64-windows/zlib1.dll"), zlib)?;
    let programs_of_wine = folder.join("usr/lib/wine");
    let server = programs_of_wine.join("wineserver64");
    // it ends with the last program, because it holds the output pipe
    let text = format!("#!/bin/sh\nexec {} -p0 \"$@\"\n", quoted(&server));
    executable(&programs_of_wine.join("wineserver"), &text)?;
    // without a display, and without the questions of the first start. fmpy's server for other platforms exits if it
    // can open its lock file, which is always possible in wine; it therefore gets no lock file.
    let text = format!(
        "#!/bin/sh\nexport LD_LIBRARY_PATH={libraries} WINEARCH=win64 WINEDEBUG=-all\n\
         [ -n \"$WINEPREFIX\" ] || export WINEPREFIX={prefix}\nexport WINEDLLOVERRIDES='mscoree,mshtml=' DISPLAY=\n\
         case \"$1\" in */server_tcp.exe) set -- \"$1\" \"$2\" ;; esac\nexec {wine} \"$@\"\n",
        libraries = quoted(&folder.join("usr/lib/x86_64-linux-gnu")),
        prefix = quoted(&folder.join("prefix")),
        wine = quoted(&programs_of_wine.join("wine64")),
    );
    executable(&start, &text)?;
    Ok(start)
}

/// A path as a word of the shell.
pub fn quoted(path: &Path) -> String {
    format!("'{}'", path.display().to_string().replace('\'', "'\\''"))
}

/// Writes a script.
///
/// # Errors
/// Those of the file system.
pub fn executable(path: &Path, text: &str) -> io::Result<()> {
    fs::write(path, text)?;
    fs::set_permissions(path, fs::Permissions::from_mode(0o755))
}

/// Linux on arm64, through QEMU.
///
/// # Errors
/// The reason why it is not available.
pub fn arm64_linux() -> Result<System, String> {
    let Qemu { start, name, .. } = qemu()?;
    let host = Host { command: vec![start, compiled("aarch64-linux-gnu.2.28", "")?], variables: Vec::new() };
    Ok(System { platform: "aarch64-linux", name, host })
}

/// The host in tests/platforms with the C `source` of an FMU, compiled with these options for `target`, on the `processor` of QEMU.
///
/// # Errors
/// The reason why it is not available.
pub fn linked(name: &str, source: &Path, (target, processor): (&str, &str), options: &[&str]) -> Result<Host, String> {
    let Packages { folder, .. } = packages("qemu", "bookworm", &["qemu-user", "libc6-arm64-cross"], true)?;
    let source = source.to_string_lossy();
    let options = [&["-static", &*source], options].concat();
    let program = compile(&format!("{name}-{target}"), "host.c", Loading::Linked, &compiler(target)?, &options)?;
    let emulator = folder.join("usr/bin").join(format!("qemu-{processor}"));
    let libraries = folder.join("usr/lib/x86_64-linux-gnu");
    let unset = ["-E", "LD_LIBRARY_PATH="].map(PathBuf::from);
    let command = [emulator].into_iter().chain(unset).chain([program]).collect();
    Ok(Host { command, variables: vec![("LD_LIBRARY_PATH", libraries)] })
}

/// The C `source` of an FMU as an object by the rules of Microsoft's compiler, which clang imitates, with these options.
///
/// # Errors
/// The reason why there is none: that it is not available, or what the compiler says.
pub fn by_microsofts_rules(name: &str, source: &Path, options: &[&str]) -> Result<PathBuf, String> {
    let object = folder_of_hosts().join(format!("{name}.obj"));
    let mut command = compile_for("x86_64-windows-msvc")?;
    command.args(["-nostdlibinc", "-fms-compatibility-version=19.30", "-fms-extensions"]);
    command.arg("-isystem").arg(folder().join("msvc")).arg("-I").arg(site_packages_file("fmpy/c-code"));
    command.args(["-DFMI2_OVERRIDE_FUNCTION_PREFIX", "-O1", "-Wall", "-Wextra", "-Werror"]).args(options);
    let output = command.arg("-c").arg(source).arg("-o").arg(&object).output().map_err(|error| error.to_string())?;
    match output.status.success() {
        true => Ok(object),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}

/// The host in tests/platforms with the C `source` of an FMU by the rules of Microsoft's compiler, in wine.
///
/// # Errors
/// The reason why it is not available.
pub fn linked_by_microsofts_rules(name: &str, source: &Path) -> Result<Host, String> {
    let (wine, _) = wine()?;
    let object = by_microsofts_rules(name, source, &[])?;
    let mark = folder().join("msvc/float_used.c");
    let parts = [&*object.to_string_lossy(), &*mark.to_string_lossy()];
    let compiler = compiler("x86_64-windows-gnu")?;
    let program = compile(&format!("{name}-msvc.exe"), "host.c", Loading::Linked, &compiler, &parts)?;
    Ok(Host { command: vec![wine, program], variables: Vec::new() })
}

/// QEMU's user mode for arm64, with the C library of arm64.
pub struct Qemu {
    /// Its name and version.
    pub name: String,
    /// The program that starts an arm64 program; it looks for libraries in the folders `ARM64_LIBRARIES`, too.
    pub start: PathBuf,
    /// The program that runs any command, and every arm64 program that it starts, by `start`.
    pub with_arm64: PathBuf,
}

/// What the header of an arm64 program has in place of the bytes of its magic number, type and processor, with a mask.
const ARM64_PROGRAM: &str = concat!(
    r":\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00",
    r":\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff:"
);

/// QEMU, unpacked.
///
/// # Errors
/// The reason why it is not available.
pub fn qemu() -> Result<Qemu, String> {
    let Packages { folder, versions } = packages("qemu", "bookworm", &["qemu-user", "libc6-arm64-cross"], true)?;
    let name = format!("QEMU {}", version_of(&versions, "qemu-user")?);
    let programs = folder.join("programs");
    let [start, with_arm64] = ["arm64", "with_arm64"].map(|name| programs.join(name));
    // its libraries are not those of the program
    let by_qemu = format!(
        "#!/bin/sh\nLD_LIBRARY_PATH={libraries} exec {qemu} -E LD_LIBRARY_PATH=\"$ARM64_LIBRARIES\" -L {root} \"$@\"\n",
        libraries = quoted(&folder.join("usr/lib/x86_64-linux-gnu")),
        qemu = quoted(&folder.join("usr/bin/qemu-aarch64")),
        root = quoted(&folder.join("usr/aarch64-linux-gnu")),
    );
    // the kernel's list of interpreters, in a namespace of its own: no root, and nothing changes outside of it
    let formats = "/proc/sys/fs/binfmt_misc";
    let in_namespace = format!(
        "#!/bin/sh\nexec unshare --user --map-root-user --mount sh -c 'mount -t binfmt_misc none {formats} &&\n\
         printf %s \":arm64:M:{ARM64_PROGRAM}$0:\" > {formats}/register && exec \"$@\"' {start} \"$@\"\n",
        start = quoted(&start),
    );
    let written = fs::create_dir_all(&programs)
        .and_then(|()| executable(&start, &by_qemu))
        .and_then(|()| executable(&with_arm64, &in_namespace));
    written.map_err(|error| format!("{}: {error}", programs.display()))?;
    Ok(Qemu { name, start, with_arm64 })
}

/// The code for macOS in an emulator of the processor; there is no macOS.
///
/// # Errors
/// The reason why it is not available.
pub fn macos(processor: &str) -> Result<System, String> {
    let command = vec![tools()?, folder().join("macho.py"), processor.into()];
    let host = Host { command, variables: Vec::new() };
    Ok(System { platform: "darwin64", name: format!("unicorn 2.1.4, {processor}"), host })
}

/// The version of `package` in the list of unpacked packages.
fn version_of<'a>(versions: &'a str, package: &str) -> Result<&'a str, String> {
    let mut lines = versions.lines().filter_map(|line| line.split_once(' '));
    lines.find(|(name, _)| *name == package).map(|(_, version)| version).ok_or(format!("no {package} was unpacked"))
}

/// The results of fmpy for `fmu` on a history, through `remote` for another system.
///
/// # Errors
/// The error output if it fails or hangs.
pub fn by_fmpy(fmu: &Path, history: &Path, remote: Option<(&str, &Host)>) -> Result<String, String> {
    let mut command = Command::new("timeout");
    command.arg("120").arg(python()).arg(folder().join("with_fmpy.py")).arg(fmu).arg(history);
    if let Some((platform, host)) = remote {
        // it looks for wine64 there
        let programs = host.command[0].parent().ok_or("wine has a folder")?.display();
        let path = std::env::var("PATH").unwrap_or_default();
        command.arg(platform).env("PATH", format!("{programs}:{path}"));
    }
    // files, not pipes: wine's services keep both open as long as any program of wine runs, of another test, too
    let [said, complaints] = ["out", "err"].map(|ending| fmu.with_extension(ending));
    let open = |path: &Path| File::create(path).map_err(|error| format!("{}: {error}", path.display()));
    let status = command.stdin(Stdio::null()).stdout(open(&said)?).stderr(open(&complaints)?).status();
    let status = status.map_err(|error| format!("{command:?}: {error}"))?;
    let [lines, complaints] = [said, complaints].map(|path| fs::read(path).unwrap_or_default());
    let lines = String::from_utf8_lossy(&lines);
    // the server of the other system also prints
    let is_row = |line: &&str| line.len() > 16 && line.bytes().all(|byte| byte == b' ' || byte.is_ascii_hexdigit());
    match status.success() {
        true => Ok(lines.lines().filter(is_row).collect::<Vec<_>>().join("\n")),
        false => Err(format!("{status}: {}", String::from_utf8_lossy(&complaints))),
    }
}
