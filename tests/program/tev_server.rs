//! A server that speaks the protocol of tev, and keeps what it receives.
use std::{
    io::Read,
    net::{TcpListener, TcpStream},
    sync::{Arc, Mutex},
    thread::JoinHandle,
};

/// A packet of the protocol: <https://github.com/Tom94/tev#over-the-network>.
#[derive(Clone, Debug, PartialEq)]
pub enum Packet {
    Create { name: String, grabs_focus: bool, size: [u32; 2], channels: Vec<String> },
    Update { name: String, grabs_focus: bool, channels: Vec<String>, origin: [u32; 2], size: [u32; 2], pixels: Vec<[f32; 3]> },
}

/// Waits for one connection.
pub struct TevServer {
    pub address: String,
    received: Arc<Mutex<Vec<Packet>>>,
    thread: JoinHandle<()>,
}

impl TevServer {
    /// Receives packets until the connection ends, or `most` of them.
    pub fn start(most: usize) -> TevServer {
        let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
        let address = listener.local_addr().expect("it has an address").to_string();
        let received = Arc::new(Mutex::new(Vec::new()));
        let kept = received.clone();
        let thread = std::thread::spawn(move || {
            let (mut socket, _) = listener.accept().expect("there is a connection");
            let packets = std::iter::from_fn(|| packet(&mut socket)).take(most);
            packets.for_each(|packet| kept.lock().expect("nothing failed").push(packet));
        });
        TevServer { address, received, thread }
    }

    /// The packets so far.
    pub fn packets(&self) -> Vec<Packet> {
        self.received.lock().expect("nothing failed").clone()
    }

    /// The packets, when the connection has ended.
    pub fn finish(self) -> Vec<Packet> {
        self.thread.join().expect("they can be read");
        self.received.lock().expect("nothing failed").clone()
    }
}

/// The pixels of the image that was created last, row by row, as all updates have left them.
pub fn image(packets: &[Packet]) -> ([u32; 2], Vec<[f32; 3]>) {
    let (mut full, mut image) = ([0; 2], Vec::new());
    for packet in packets {
        match packet {
            Packet::Create { size, .. } => {
                (full, image) = (*size, vec![[0.0; 3]; size[0] as usize * size[1] as usize]);
            }
            Packet::Update { origin: [x, y], size: [width, _], pixels, .. } => {
                for (row, pixels) in (*y..).zip(pixels.chunks(*width as usize)) {
                    let start = (row * full[0] + x) as usize;
                    image[start..start + pixels.len()].copy_from_slice(pixels);
                }
            }
        }
    }
    (full, image)
}

/// The next packet. `None` if the connection has ended.
fn packet(socket: &mut TcpStream) -> Option<Packet> {
    let mut length = [0; 4];
    socket.read_exact(&mut length).ok()?;
    let mut bytes = vec![0; u32::from_le_bytes(length) as usize - 4];
    socket.read_exact(&mut bytes).ok()?;
    let mut reader = Reader(&bytes);
    let packet = match reader.byte() {
        4 => create(&mut reader),
        6 => update(&mut reader),
        other => panic!("packet {other} is not expected"),
    };
    assert!(reader.0.is_empty(), "the packet has the length that it states");
    Some(packet)
}

fn create(reader: &mut Reader) -> Packet {
    let (grabs_focus, name) = (reader.byte() == 1, reader.text());
    let size = [reader.int(), reader.int()];
    let count = reader.int();
    Packet::Create { name, grabs_focus, size, channels: (0..count).map(|_| reader.text()).collect() }
}

/// An update whose pixels have three interleaved channels.
fn update(reader: &mut Reader) -> Packet {
    let (grabs_focus, name) = (reader.byte() == 1, reader.text());
    let count = reader.int();
    let channels = (0..count).map(|_| reader.text()).collect();
    let (origin, size) = ([reader.int(), reader.int()], [reader.int(), reader.int()]);
    let offsets: Vec<u64> = (0..count).map(|_| reader.long()).collect();
    let strides: Vec<u64> = (0..count).map(|_| reader.long()).collect();
    assert_eq!((offsets, strides), (vec![0, 1, 2], vec![3, 3, 3]));
    let pixels = (0..size[0] * size[1]).map(|_| [reader.float(), reader.float(), reader.float()]).collect();
    Packet::Update { name, grabs_focus, channels, origin, size, pixels }
}

struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (taken, rest) = self.0.split_first_chunk().expect("the packet is whole");
        self.0 = rest;
        *taken
    }

    fn byte(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    fn int(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn long(&mut self) -> u64 {
        u64::from_le_bytes(self.take())
    }

    fn float(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    fn text(&mut self) -> String {
        let end = self.0.iter().position(|byte| *byte == 0).expect("a text ends with a zero");
        let text = String::from_utf8(self.0[..end].to_vec()).expect("it is text");
        self.0 = &self.0[end + 1..];
        text
    }
}
