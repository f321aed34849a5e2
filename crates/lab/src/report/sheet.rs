//! Sheets of labelled images, as one PNG.
use plotters::prelude::*;

use super::{font, picture::rgb_png};

/// Margin between and around images, in pixels.
const MARGIN: u32 = 12;
const LINE: u32 = 18;
const FONT: u32 = 15;
/// Minimum width of a cell, for its labels.
const LEAST_WIDTH: u32 = 200;
/// Maximum number of pixels of a sheet.
const MOST_PIXELS: u64 = 1 << 27;

/// An image with lines of text below it.
pub struct Cell {
    /// The lines below the image.
    pub lines: Vec<String>,
    /// Display pixels, row by row.
    pub pixels: Vec<[u8; 4]>,
}

/// The layout of a sheet.
struct Layout {
    columns: u32,
    /// Size of an image.
    picture: [u32; 2],
    /// Size of an image with its lines and a margin.
    cell: [u32; 2],
    /// Height of the title with its margin.
    head: u32,
    size: [u32; 2],
}

impl Layout {
    /// The layout of `count` images; `lines` are the lines of each and of the title.
    fn new(picture: [u32; 2], columns: u32, count: u32, lines: [u32; 2]) -> Result<Layout, String> {
        let [lines, of_title] = lines;
        let columns = columns.clamp(1, count.max(1));
        let rows = count.div_ceil(columns);
        let cell = [picture[0].max(LEAST_WIDTH) + MARGIN, picture[1] + LINE * lines + 2 * MARGIN];
        let head = if of_title == 0 { MARGIN } else { LINE * of_title + 2 * MARGIN };
        let [width, height] =
            [u64::from(columns) * u64::from(cell[0]) + u64::from(MARGIN), u64::from(rows) * u64::from(cell[1]) + u64::from(head)];
        if width * height > MOST_PIXELS {
            return Err(format!("the sheet would be {width} × {height} pixels: make the images smaller with --size"));
        }
        Ok(Layout { columns, picture, cell, head, size: [width as u32, height as u32] })
    }

    /// The upper left corner of an image.
    fn corner(&self, number: u32) -> [u32; 2] {
        let (column, row) = (number % self.columns, number / self.columns);
        [MARGIN + column * self.cell[0], self.head + row * self.cell[1]]
    }
}

/// Checks the size of a sheet of `count` images; the error gives the size.
pub fn check(picture: [u32; 2], columns: u32, count: u32) -> Result<(), String> {
    Layout::new(picture, columns, count, [2, 2]).map(|_| ())
}

fn layout(picture: [u32; 2], columns: u32, title: &[String], cells: &[Cell]) -> Result<Layout, String> {
    let lines = cells.iter().map(|cell| cell.lines.len()).max().unwrap_or(0);
    Layout::new(picture, columns, cells.len() as u32, [lines as u32, title.len() as u32])
}

/// A PNG with images of this size in `columns` columns, below a title.
pub fn sheet(picture: [u32; 2], columns: u32, title: &[String], cells: &[Cell]) -> Result<Vec<u8>, String> {
    let layout = layout(picture, columns, title, cells)?;
    let [width, height] = layout.size;
    let mut rgb = vec![255; 3 * width as usize * height as usize];
    for (number, cell) in (0..).zip(cells) {
        let [left, top] = layout.corner(number);
        for (y, row) in (top..).zip(cell.pixels.chunks(layout.picture[0] as usize)) {
            let start = 3 * (y as usize * width as usize + left as usize);
            rgb[start..start + 3 * row.len()]
                .copy_from_slice(&row.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect::<Vec<u8>>());
        }
    }
    write_labels(&layout, &mut rgb, title, cells).map_err(|error| error.to_string())?;
    rgb_png(layout.size, &rgb)
}

fn write_labels(layout: &Layout, rgb: &mut [u8], title: &[String], cells: &[Cell]) -> Result<(), Box<dyn std::error::Error>> {
    font::register();
    let [width, height] = layout.size;
    let area = BitMapBackend::with_buffer(rgb, (width, height)).into_drawing_area();
    let style = ("sans-serif", FONT).into_font().color(&BLACK);
    let write = |text: &str, x: u32, y: u32| area.draw(&Text::new(text.to_owned(), (x as i32, y as i32), style.clone()));
    for (y, line) in (MARGIN..).step_by(LINE as usize).zip(title) {
        write(line, MARGIN, y)?;
    }
    for (number, cell) in (0..).zip(cells) {
        let [left, top] = layout.corner(number);
        for (y, line) in (top + layout.picture[1] + MARGIN / 2..).step_by(LINE as usize).zip(&cell.lines) {
            write(line, left, y)?;
        }
    }
    area.present()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_pictures_leave_room_for_their_labels() {
        let width = |picture: u32| Layout::new([picture, 10], 2, 4, [1, 1]).map(|layout| layout.size[0]);
        let of = |cell: u32| Ok(2 * (cell + MARGIN) + MARGIN);
        assert_eq!([10, 300].map(width), [of(LEAST_WIDTH), of(300)]);
    }

    #[test]
    fn pictures_stand_in_rows_with_ink_below_them() {
        let cell = |colour: u8, lines: &[&str]| Cell {
            lines: lines.iter().map(|line| (*line).to_owned()).collect(),
            pixels: vec![[colour, 0, 0, 255]; 300 * 10],
        };
        let cells = [cell(10, &["path", "16 spp"]), cell(20, &["mis", "16 spp"]), cell(30, &[])];
        let bytes = sheet([300, 10], 2, &["A scene".to_owned()], &cells).expect("a sheet");
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
        let mut rgb = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut rgb).expect("pixels");
        let layout = layout([300, 10], 2, &["A scene".to_owned()], &cells).expect("a layout");
        assert_eq!([info.width, info.height], layout.size);
        let at = |x: u32, y: u32| &rgb[3 * (y * info.width + x) as usize..][..3];
        for (number, colour) in [(0, 10), (1, 20), (2, 30)] {
            let [left, top] = layout.corner(number);
            assert_eq!((at(left, top), at(left + 299, top + 9)), (&[colour, 0, 0][..], &[colour, 0, 0][..]));
            assert_eq!(at(left - 1, top), [255; 3]);
            let below = (0..2 * LINE).flat_map(|y| (0..60).map(move |x| (left + x, top + 10 + MARGIN / 2 + y)));
            let ink = below.filter(|(x, y)| at(*x, *y)[0] < 128).count();
            assert_eq!(ink > 20, number < 2, "{ink} dark pixels below image {number}");
        }
        assert!(check([4096, 4096], 2, 6).is_ok());
        assert!(check([4096, 4096], 2, 9).is_err_and(|error| error.contains("--size")));
    }
}
