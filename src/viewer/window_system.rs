//! Selects the window system, and reports an error if none answers.
//!
//! If both X11 and Wayland are present, Wayland is preferred if its display answers; a name without a display is ignored.

/// The displays that the environment names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Displays {
    /// Of Wayland, and whether something answers there.
    pub wayland: Option<(String, bool)>,
    pub x11: Option<String>,
}

/// Where to open the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WindowSystem {
    /// Where the windowing library opens it by itself.
    Default,
    X11,
}

impl Displays {
    /// Where to open the window, or why there is no place.
    pub fn choose(&self) -> Result<WindowSystem, String> {
        match (&self.wayland, &self.x11) {
            (Some((_, true)), _) => Ok(WindowSystem::Default),
            (_, Some(_)) => Ok(WindowSystem::X11),
            (Some((name, false)), None) => Err(format!(
                "no display was found: nothing answers at the Wayland display `{name}` (WAYLAND_DISPLAY), and DISPLAY is not set"
            )),
            (None, None) => Err("no display was found (neither DISPLAY nor WAYLAND_DISPLAY is set)".to_owned()),
        }
    }

    /// Why the chosen window system does not let us in.
    pub fn refusal(&self) -> String {
        let wayland = self.wayland.as_ref().map(|(name, _)| format!("the Wayland display `{name}` (WAYLAND_DISPLAY)"));
        let x11 = self.x11.as_ref().map(|name| format!("the X display `{name}` (DISPLAY)"));
        match (wayland, x11) {
            (Some(wayland), Some(x11)) if self.choose() == Ok(WindowSystem::X11) => {
                format!("neither {wayland} nor {x11} answers")
            }
            (Some(display), _) | (None, Some(display)) => format!("{display} does not answer or refuses this program"),
            (None, None) => "the window system does not answer".to_owned(),
        }
    }

    /// Describes an error of the windowing library without places in its source.
    pub fn explain(&self, error: &eframe::Error) -> String {
        match error {
            eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => self.refusal(),
            eframe::Error::NoGlutinConfigs(..) => "the display does not offer the OpenGL that the window needs".to_owned(),
            other => self.without_source(&other.to_string()),
        }
    }

    /// A message, unless it quotes a source file.
    pub fn without_source(&self, message: &str) -> String {
        if message.contains(".rs") { self.refusal() } else { message.to_owned() }
    }
}

#[cfg(all(unix, not(target_os = "macos")))]
pub use self::free_unix::{force, found};

/// Systems on which a window needs a display server.
#[cfg(all(unix, not(target_os = "macos")))]
mod free_unix {
    use std::{
        env::var_os,
        ffi::OsStr,
        io::{Read, Result, Write},
        os::unix::net::UnixStream,
        path::Path,
        time::Duration,
    };

    use eframe::NativeOptions;
    use winit::platform::x11::EventLoopBuilderExtX11;

    use super::{Displays, WindowSystem};

    /// The displays that the environment names.
    pub fn found() -> Displays {
        let named = |variable| var_os(variable).filter(|value| !value.is_empty());
        let text = |value: &OsStr| value.to_string_lossy().into_owned();
        let socket = named("WAYLAND_SOCKET").map(|socket| (text(&socket), true));
        let by_name = || named("WAYLAND_DISPLAY").map(|name| (text(&name), answers(&name)));
        Displays { wayland: socket.or_else(by_name), x11: named("DISPLAY").map(|name| text(&name)) }
    }

    /// Whether a Wayland display answers at its socket: a path, or a name in the folder of the session.
    pub fn answers(name: &OsStr) -> bool {
        const PATIENCE: Duration = Duration::from_secs(2);
        // `wl_display.get_registry`: of object 1 the request 1, 12 bytes long, for a new object 2. A display answers with all it offers.
        let request = [1u32, 12 << 16 | 1, 2].map(u32::to_ne_bytes).concat();
        let folder = var_os("XDG_RUNTIME_DIR").unwrap_or_default();
        let ask = || -> Result<usize> {
            let mut display = UnixStream::connect(Path::new(&folder).join(name))?;
            display.set_read_timeout(Some(PATIENCE))?;
            display.write_all(&request)?;
            display.read(&mut [0; 8])
        };
        ask().is_ok_and(|bytes| bytes > 0)
    }

    pub fn force(system: WindowSystem, options: &mut NativeOptions) {
        if system == WindowSystem::X11 {
            options.event_loop_builder = Some(Box::new(|builder| {
                builder.with_x11();
            }));
        }
    }
}

/// Systems whose windows need no display server: their one window system is always there.
#[cfg(not(all(unix, not(target_os = "macos"))))]
pub fn found() -> Displays {
    Displays { wayland: Some((String::new(), true)), x11: None }
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
pub fn force(_: WindowSystem, _: &mut eframe::NativeOptions) {}

#[cfg(test)]
mod tests {
    use super::*;

    fn displays(wayland: Option<(&str, bool)>, x11: Option<&str>) -> Displays {
        Displays { wayland: wayland.map(|(name, answers)| (name.to_owned(), answers)), x11: x11.map(str::to_owned) }
    }

    #[test]
    fn wayland_is_preferred_where_it_answers_and_passed_over_where_it_does_not() {
        for (wayland, x11, system) in [
            (Some(("wayland-0", true)), Some(":0"), WindowSystem::Default),
            (Some(("wayland-0", true)), None, WindowSystem::Default),
            (Some(("nowhere", false)), Some(":0"), WindowSystem::X11),
            (None, Some(":0"), WindowSystem::X11),
        ] {
            assert_eq!(displays(wayland, x11).choose(), Ok(system), "{wayland:?} {x11:?}");
        }
        let dead = displays(Some(("nowhere", false)), None).choose().expect_err("nothing answers");
        assert!(dead.contains("`nowhere`") && dead.contains("DISPLAY is not set"), "{dead}");
        let none = displays(None, None).choose().expect_err("nothing is named");
        assert!(none.contains("neither DISPLAY nor WAYLAND_DISPLAY is set"), "{none}");
    }

    #[test]
    fn a_refusal_names_the_tried_displays_and_no_source() {
        let refusal = |wayland, x11| displays(wayland, x11).refusal();
        assert_eq!(
            refusal(Some(("nowhere", false)), Some(":7")),
            "neither the Wayland display `nowhere` (WAYLAND_DISPLAY) nor the X display `:7` (DISPLAY) answers"
        );
        assert_eq!(refusal(None, Some(":7")), "the X display `:7` (DISPLAY) does not answer or refuses this program");
        let both = refusal(Some(("wayland-0", true)), Some(":7"));
        assert!(both.contains("wayland-0") && !both.contains(":7"), "only Wayland was tried: {both}");
        let here = displays(None, Some(":7"));
        assert_eq!(here.without_source("os error at /some/where/mod.rs:7: it failed"), here.refusal());
        assert_eq!(here.without_source("a library is missing"), "a library is missing");
    }

    #[cfg(all(unix, not(target_os = "macos")))]
    #[test]
    fn a_display_answers_where_something_does_at_its_socket() {
        use std::io::{Read, Write};

        let folder = tempfile::tempdir().expect("a folder");
        let socket = folder.path().join("wayland-7");
        let answers = || free_unix::answers(socket.as_os_str());
        assert!(!answers(), "there is no socket");
        let listener = std::os::unix::net::UnixListener::bind(&socket).expect("a socket can be made");
        let display = std::thread::spawn(move || {
            // The first caller is turned away, the second one is answered.
            for answer in [&[][..], &[7; 8][..]] {
                let (mut caller, _) = listener.accept().expect("somebody calls");
                caller.read_exact(&mut [0; 12]).expect("a request");
                caller.write_all(answer).expect("the caller listens");
            }
        });
        assert!(!answers() && answers());
        display.join().expect("it ends");
        assert!(!answers(), "its file is still there, but nobody listens");
    }
}
