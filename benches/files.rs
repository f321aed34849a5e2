//! Reading of mesh files: `cargo bench --bench files`.
//!
//! Writes a height field in every format to a temporary folder, reads it, and prints the rate and the peak memory. The size of the files
//! is 100 MB, or as many as `NOISEFALL_FILE_MB` says. The trees over triangles are built later and are not part of this.
#![allow(clippy::print_stdout, reason = "the result")]
use std::{
    error::Error,
    fs::{self, File},
    io::{BufWriter, Write},
    path::Path,
    process::Command,
    time::Instant,
};

use noisefall_formats::import::{ImportOptions, read};

/// Counts allocated bytes.
#[global_allocator]
static MEMORY: cap::Cap<std::alloc::System> = cap::Cap::new(std::alloc::System, usize::MAX);

type Done = Result<(), Box<dyn Error>>;

/// A height field of `side` × `side` vertices.
#[derive(Clone, Copy)]
struct Field {
    side: u32,
}

impl Field {
    /// A field whose file has about this size.
    fn of_size(bytes: f64, bytes_per_vertex: f64) -> Field {
        Field { side: ((bytes / bytes_per_vertex).sqrt() as u32).max(2) }
    }

    fn vertices(self) -> impl Iterator<Item = [f32; 3]> {
        let height = |x: u32, y: u32| (x as f32 * 0.37).sin() * (y as f32 * 0.23).cos();
        (0..self.side).flat_map(move |y| (0..self.side).map(move |x| [x as f32 * 0.1, height(x, y), y as f32 * 0.1]))
    }

    fn triangles(self) -> impl Iterator<Item = [u32; 3]> {
        let corners = (0..self.side - 1).flat_map(move |y| (0..self.side - 1).map(move |x| y * self.side + x));
        corners.flat_map(move |a| [[a, a + self.side, a + 1], [a + 1, a + self.side, a + self.side + 1]])
    }
}

fn ply(field: Field, to: &mut dyn Write) -> Done {
    let (vertices, faces) = (field.side * field.side, 2 * (field.side - 1) * (field.side - 1));
    write!(
        to,
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )?;
    field.vertices().flatten().try_for_each(|x| to.write_all(&x.to_le_bytes()))?;
    for triangle in field.triangles() {
        to.write_all(&[3])?;
        triangle.iter().try_for_each(|index| to.write_all(&index.to_le_bytes()))?;
    }
    Ok(())
}

fn obj(field: Field, to: &mut dyn Write) -> Done {
    field.vertices().try_for_each(|[x, y, z]| writeln!(to, "v {x} {y} {z}"))?;
    Ok(field.triangles().try_for_each(|[a, b, c]| writeln!(to, "f {} {} {}", a + 1, b + 1, c + 1))?)
}

fn stl(field: Field, to: &mut dyn Write) -> Done {
    let vertices: Vec<[f32; 3]> = field.vertices().collect();
    to.write_all(&[b' '; 80])?;
    to.write_all(&(2 * (field.side - 1) * (field.side - 1)).to_le_bytes())?;
    for triangle in field.triangles() {
        let places = triangle.map(|index| vertices[index as usize]);
        [[0.0f32; 3]].iter().chain(&places).flatten().try_for_each(|x| to.write_all(&x.to_le_bytes()))?;
        to.write_all(&[0; 2])?;
    }
    Ok(())
}

fn glb(field: Field, to: &mut dyn Write) -> Done {
    let (vertices, indices) = (field.side * field.side, 6 * (field.side - 1) * (field.side - 1));
    let end = 0.1 * field.side as f32;
    let json = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0}}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"NORMAL\":1}},\"indices\":2}}]}}],\
         \"buffers\":[{{\"byteLength\":{all}}}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{third}}},\
         {{\"buffer\":0,\"byteOffset\":{third},\"byteLength\":{third}}},{{\"buffer\":0,\"byteOffset\":{two},\"byteLength\":{rest}}}],\
         \"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\",\"min\":[0,-1,0],\
         \"max\":[{end},1,{end}]}},{{\"bufferView\":1,\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\"}},\
         {{\"bufferView\":2,\"componentType\":5125,\"count\":{indices},\"type\":\"SCALAR\"}}]}}",
        third = 12 * vertices,
        two = 24 * vertices,
        rest = 4 * indices,
        all = 24 * vertices + 4 * indices,
    );
    let json = format!("{json:<width$}", width = json.len().next_multiple_of(4));
    let binary = 24 * vertices + 4 * indices;
    to.write_all(b"glTF")?;
    [2, 28 + json.len() as u32 + binary, json.len() as u32].iter().try_for_each(|word| to.write_all(&word.to_le_bytes()))?;
    write!(to, "JSON{json}")?;
    to.write_all(&binary.to_le_bytes())?;
    to.write_all(b"BIN\0")?;
    field.vertices().flatten().try_for_each(|x| to.write_all(&x.to_le_bytes()))?;
    (0..vertices).flat_map(|_| [0.0f32, 1.0, 0.0]).try_for_each(|x| to.write_all(&x.to_le_bytes()))?;
    Ok(field.triangles().flatten().try_for_each(|index| to.write_all(&index.to_le_bytes()))?)
}

/// Reads a file three times. In a process of its own, as the peak of the memory is that of a process.
fn measure(path: &Path) -> Done {
    let bytes = fs::metadata(path)?.len() as f64;
    let before = MEMORY.allocated();
    for _ in 0..3 {
        let start = Instant::now();
        let scene = read(path, &ImportOptions::default())?;
        let seconds = start.elapsed().as_secs_f64();
        let [kept, peak] = [MEMORY.allocated(), MEMORY.max_allocated()].map(|bytes| bytes.saturating_sub(before) as f64);
        println!(
            "{:>4} {:>7.0} MB {seconds:>7.3} s {:>6.0} MB/s, kept {:.0} MB, peak {:.2} of that",
            path.extension().unwrap_or_default().to_string_lossy(),
            bytes / 1e6,
            bytes / 1e6 / seconds,
            kept / 1e6,
            peak / kept
        );
        drop(scene);
    }
    Ok(())
}

fn main() -> Done {
    /// Names the file to read in a process of its own.
    const FILE: &str = "NOISEFALL_BENCH_FILE";
    if let Some(path) = std::env::var_os(FILE) {
        return measure(Path::new(&path));
    }
    let megabytes: f64 = std::env::var("NOISEFALL_FILE_MB").ok().and_then(|text| text.parse().ok()).unwrap_or(100.0);
    println!("on {} threads", rayon::current_num_threads());
    let folder = tempfile::tempdir()?;
    type Format = (&'static str, f64, fn(Field, &mut dyn Write) -> Done);
    let formats: [Format; 4] = [("ply", 38.0, ply), ("obj", 82.0, obj), ("stl", 100.0, stl), ("glb", 48.0, glb)];
    for (extension, bytes_per_vertex, write) in formats {
        let path = folder.path().join("field").with_extension(extension);
        let mut file = BufWriter::new(File::create(&path)?);
        write(Field::of_size(megabytes * 1e6, bytes_per_vertex), &mut file)?;
        file.into_inner()?.sync_all()?;
        Command::new(std::env::current_exe()?).env(FILE, &path).status()?;
        fs::remove_file(&path)?;
    }
    Ok(())
}
