//! The files of the chapter.
use super::{
    exhibits::{Exhibits, SheetPicture},
    page,
};
use crate::report::{picture::svg, plot::Plot, table::Table};

/// The output: a page, and each of its figures and tables as a file.
pub struct Chapter {
    /// The page.
    pub html: String,
    /// Names and contents of the files.
    pub files: Vec<(String, Vec<u8>)>,
    /// Errors of plots that could not be drawn.
    pub failures: Vec<String>,
}

impl Chapter {
    /// The chapter of these exhibits.
    pub fn new(exhibits: &Exhibits) -> Chapter {
        let (tables, plots) = (exhibits.tables(), exhibits.plots());
        let mut chapter = Chapter { html: page::html(exhibits, &tables, &plots), files: Vec::new(), failures: Vec::new() };
        tables.iter().for_each(|table| chapter.add_table(table));
        plots.iter().for_each(|(name, _, plot)| chapter.add_plot(name, plot));
        exhibits.pictures.iter().for_each(|picture| chapter.add_picture(picture));
        chapter
    }

    fn add_table(&mut self, table: &Table) {
        self.add(format!("{}.csv", table.name), table.csv());
        self.add(format!("{}.tex", table.name), Ok(table.latex().into_bytes()));
    }

    fn add_plot(&mut self, name: &str, plot: &Plot) {
        self.add(format!("{name}.svg"), Ok(plot.svg().into_bytes()));
        self.add(format!("{name}.png"), plot.png());
    }

    fn add_picture(&mut self, picture: &SheetPicture) {
        self.add(format!("{}.svg", picture.name), svg(&picture.png));
        self.add(format!("{}.png", picture.name), Ok(picture.png.clone()));
    }

    fn add(&mut self, name: String, bytes: Result<Vec<u8>, String>) {
        match bytes {
            Ok(bytes) => self.files.push((name, bytes)),
            Err(error) => self.failures.push(format!("{name}: {error}")),
        }
    }
}
