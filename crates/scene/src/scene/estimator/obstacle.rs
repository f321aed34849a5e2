//! Obstacles to light paths. Estimators that need them work like `mis` where there is one, and say why.
use noisefall_base::declare::{Word, Words};

use super::Estimator;

noisefall_base::declare::words! {
    /// A property of a scene or of settings in which some estimators trace no light paths.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Obstacle {
        LongPaths: "long_paths", "so little roulette and no low bounce cap", "There would be too many connections between paths.";
        CountedCrossings: "counted_crossings", "crossed surfaces that count as bounces", "A light path does not know how many surfaces a connection crosses.";
        OneSided: "one_sided", "materials that let light pass differently from their two sides", "A path is not the same in reverse.";
        HiddenMedium: "hidden_medium", "tinted glass with opacity or in a blend", "Light enters the glass without its medium, and a path is not the same in reverse.";
        OpenMedium: "open_medium", "tinted glass that is open, or that overlaps with other glass", "A path is not the same in reverse. 512 walks test that.";
        NoStart: "no_start", "no light at which paths can start, or too many of them", "There is nothing to trace.";
        ShadingNormals: "shading_normals", "smooth meshes, bump or normal maps", "From some sides, their normals are not those that a light path sees.";
        Isosurface: "isosurface", "isosurfaces that emit light", "No points of them are sampled.";
        ClearLight: "clear_light", "lights that let light pass", "A path would start within the surface.";
        FarWithinMedium: "far_within_medium", "light from far away within a medium", "It has no distance over which the medium attenuates it.";
        LightAtGlass: "light_at_glass", "lights that may touch or cross the surface of a dielectric", "The media around them are not known.";
    }
}

/// Which estimators an obstacle stops.
enum Stops {
    /// All with light paths.
    All,
    /// Those that connect light paths with all vertices of camera paths.
    Connecting,
    /// Those that find this light by light paths alone. The others find it by camera paths.
    Alone,
}

impl Obstacle {
    const fn stopped(self) -> Stops {
        match self {
            Obstacle::LongPaths => Stops::Connecting,
            Obstacle::CountedCrossings
            | Obstacle::OneSided
            | Obstacle::HiddenMedium
            | Obstacle::OpenMedium
            | Obstacle::NoStart => Stops::All,
            Obstacle::ShadingNormals
            | Obstacle::Isosurface
            | Obstacle::ClearLight
            | Obstacle::FarWithinMedium
            | Obstacle::LightAtGlass => Stops::Alone,
        }
    }

    /// Whether the estimator works like `mis` with it.
    pub fn stops(self, estimator: Estimator) -> bool {
        estimator.traces_light_paths()
            && match self.stopped() {
                Stops::All => true,
                Stops::Connecting => estimator.connects(),
                Stops::Alone => !estimator.connects() && !estimator.traces_only_caustics(),
            }
    }
}

impl Estimator {
    /// The obstacles that stop the estimator.
    pub fn obstacles(self) -> impl Iterator<Item = Obstacle> {
        Obstacle::ALL.into_iter().filter(move |obstacle| obstacle.stops(self))
    }

    /// Its purpose, its strategies, and where another one runs instead: the tooltip of its entry.
    pub fn explanation(self) -> String {
        let Word { doc, .. } = self.word();
        let obstacles: Vec<&str> = self.obstacles().map(|obstacle| obstacle.word().title).collect();
        let fallback = match obstacles.split_last() {
            Some((last, others)) => format!("\n\nWorks like MIS with {} or {last}.", others.join(", ")),
            None => String::new(),
        };
        format!("{doc}\n\nStrategies: {}.{fallback}", self.strategies())
    }

    /// All estimators as a table in Markdown: the strategies of each, and what it cannot have. A number stands for an obstacle of the
    /// list below the table.
    pub fn table() -> String {
        let number = |obstacle: Obstacle| 1 + Obstacle::ALL.iter().position(|other| *other == obstacle).unwrap_or_default();
        let mut text = "| estimator | strategies | works like `mis` with |\n|---|---|---|\n".to_owned();
        for estimator in Estimator::ALL {
            let numbers: Vec<String> = estimator.obstacles().map(|obstacle| number(obstacle).to_string()).collect();
            let numbers = if numbers.is_empty() { "–".to_owned() } else { numbers.join(", ") };
            text += &format!("| `{}` | {} | {numbers} |\n", estimator.name(), estimator.strategies());
        }
        text.push('\n');
        for (Word { title, doc, .. }, obstacle) in Obstacle::words() {
            text += &format!("{}. {title}: {}{}\n", number(*obstacle), doc[..1].to_lowercase(), &doc[1..]);
        }
        text
    }
}
