//! Sends images to the viewer [tev](https://github.com/Tom94/tev) while they are rendered, by its protocol over TCP.
//!
//! tev gets linear radiance: no exposure, no white balance, no tone map.
mod stream;

use std::{
    io::{self, ErrorKind},
    net::{TcpStream, ToSocketAddrs},
    time::Duration,
};

use tev_client::{PacketCreateImage, PacketUpdateImage, TevClient};

pub use self::stream::TevStream;
use super::frame::Frame;

/// The address that tev listens on by default.
pub const DEFAULT_ADDRESS: &str = "127.0.0.1:14158";

/// Time limit of a connection, and of every packet.
const PATIENCE: Duration = Duration::from_secs(5);
/// Values of a packet: one of a large image would have to be kept in memory whole.
const MOST_VALUES: usize = 1 << 20;
const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// Error of a connection to tev.
#[derive(Debug, thiserror::Error)]
pub enum TevError {
    /// There is no connection.
    #[error("tev cannot be reached at {address}: {reason}; start tev, or give the address that it listens on as HOST:PORT")]
    Unreachable {
        /// The address.
        address: String,
        /// The message of the operating system.
        reason: String,
    },
    /// The connection has ended.
    #[error("the connection to tev at {address} was lost: {reason}; connect again to continue")]
    Lost {
        /// The address.
        address: String,
        /// The message of the operating system.
        reason: String,
    },
    /// The last image was not taken in time.
    #[error("tev at {address} takes the image too slowly: the connection is closed, and tev may not have the last image")]
    Slow {
        /// The address.
        address: String,
    },
}

/// Checks that a text is an address: HOST:PORT. Whether the host exists is not checked.
pub fn check_address(text: &str) -> Result<(), String> {
    let parts = text.rsplit_once(':');
    let is_address = parts.is_some_and(|(host, port)| !host.is_empty() && port.parse::<u16>().is_ok_and(|port| port > 0));
    if is_address { Ok(()) } else { Err(format!("expected HOST:PORT, such as {DEFAULT_ADDRESS}")) }
}

/// A connection to tev.
pub struct Tev {
    client: TevClient,
    /// Ends the connection.
    socket: TcpStream,
    address: String,
    /// Name and size of the image that was created last.
    created: Option<(String, [u32; 2])>,
}

impl Tev {
    /// Connects to the tev at HOST:PORT. Waits a few seconds at most.
    pub fn connect(address: &str) -> Result<Tev, TevError> {
        let unreachable = |reason: String| TevError::Unreachable { address: address.to_owned(), reason };
        let of_system = |error: io::Error| unreachable(reason(&error));
        let mut failure = unreachable("there is no such host".to_owned());
        for at in address.to_socket_addrs().map_err(|error| unreachable(error.to_string()))? {
            match TcpStream::connect_timeout(&at, PATIENCE) {
                Ok(socket) => {
                    socket.set_write_timeout(Some(PATIENCE)).map_err(of_system)?;
                    let client = TevClient::wrap(socket.try_clone().map_err(of_system)?);
                    return Ok(Tev { client, socket, address: address.to_owned(), created: None });
                }
                Err(error) => failure = of_system(error),
            }
        }
        Err(failure)
    }

    /// The address, as it was given.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Shows the radiance of a frame as the image of this name. An image of another name or size is created first; one that tev has
    /// already is replaced.
    pub fn show(&mut self, name: &str, frame: &Frame) -> Result<(), TevError> {
        // The protocol ends texts with a zero.
        let name = name.replace('\0', " ");
        let size @ [width, height] = [frame.width, frame.height];
        if self.created.as_ref().is_none_or(|(of, at)| (of, at) != (&name, &size)) {
            let packet = PacketCreateImage { image_name: &name, grab_focus: true, width, height, channel_names: &CHANNELS };
            self.client.send(packet).map_err(|error| self.lost(&error))?;
        }
        let rows = (MOST_VALUES / (CHANNELS.len() * width as usize)).max(1);
        for (y, band) in (0..height).step_by(rows).zip(frame.radiance.chunks(rows * width as usize)) {
            let packet = PacketUpdateImage {
                image_name: &name,
                grab_focus: false,
                channel_names: &CHANNELS,
                channel_offsets: &[0, 1, 2],
                channel_strides: &[3; 3],
                x: 0,
                y,
                width,
                height: (height - y).min(rows as u32),
                data: band.as_flattened(),
            };
            self.client.send(packet).map_err(|error| self.lost(&error))?;
        }
        self.created = Some((name, size));
        Ok(())
    }

    fn lost(&self, error: &io::Error) -> TevError {
        TevError::Lost { address: self.address.clone(), reason: reason(error) }
    }
}

/// The message of an error, without numbers of the system.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::ConnectionRefused => "nothing listens there".to_owned(),
        ErrorKind::WouldBlock | ErrorKind::TimedOut => format!("no answer in {} seconds", PATIENCE.as_secs()),
        ErrorKind::BrokenPipe | ErrorKind::ConnectionReset | ErrorKind::ConnectionAborted => "tev has closed it".to_owned(),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_a_host_and_a_port() {
        for right in [DEFAULT_ADDRESS, "localhost:1", "[::1]:14158"] {
            assert_eq!(check_address(right), Ok(()), "{right}");
        }
        for wrong in ["", "localhost", ":14158", "localhost:", "localhost:tev", "localhost:0", "localhost:70000", "room.toml"] {
            assert!(check_address(wrong).is_err_and(|error| error.contains(DEFAULT_ADDRESS)), "{wrong}");
        }
    }

    #[test]
    fn a_host_that_is_none_is_named() {
        let error = Tev::connect("no-such-host.invalid:14158").err().expect("there is none").to_string();
        assert!(error.contains("no-such-host.invalid:14158") && error.contains("start tev"), "{error}");
    }
}
