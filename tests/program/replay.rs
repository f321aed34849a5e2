//! `render --pixel`: a path as text and LaTeX, and samples as a table.
use std::fs;

use noisefall_kernel::integrator::End;

use super::command_line::{Shell, json, scene, text};

fn replay(shell: &Shell, name: &str, options: &[&str]) -> String {
    let output = shell.run(&[&["render", &scene(name), "--pixel", "20,30", "--size", "64x48"], options].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn a_path_is_printed_with_settings_nested_sum_and_end() {
    let shell = Shell::new();
    let exact = ["--estimator", "path", "--directions", "cosine", "--roulette", "off", "--max-bounces", "2", "--sample", "5"];
    let exact = [&exact[..], &["--reuse", "off", "--adaptive", "on"]].concat();
    let said = replay(&shell, "furnace", &exact);
    for part in [
        "pixel 20,30, sample 5: radiance 1.75",
        "settings        estimator path, merging off, directions cosine, sampler sobol,",
        "max_bounces 2, count_crossings off, roulette off, reuse off,",
        "adaptive on, seed 0",
        "64 × 48 pixels",
        "L = L_e(x₀) + f₀ cos θ₀/p₀ (L_e(x₁) + f₁ cos θ₁/p₁ (…))",
        "  = 1.75",
        "throughput      0.25000 0.25000 0.25000",
        "emission        Le 1.00000 1.00000 1.00000, weight 1.00000",
        "adds 0.25000 0.25000 0.25000",
        "radiance so far 1.75000 1.75000 1.75000",
        "reflected: diffuse reflection",
        "The path ends at the cap on bounces.",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let latex = replay(&shell, "furnace", &[&exact[..], &["--latex"]].concat());
    assert!(
        latex.contains("% The path ends at the cap") && latex.contains("\\begin{align*}") && latex.contains("&= 1.75"),
        "{latex}"
    );
}

#[test]
fn the_reason_for_the_end_of_a_path_is_printed() {
    let shell = Shell::new();
    let end = |text: &str, options: &[&str]| {
        let head = "format = 1\ncamera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8] }\n";
        fs::write(shell.path("a.toml"), format!("{head}{text}")).expect("it is written");
        let line = json(&shell.run(&[&["render", "a.toml", "--pixel", "4,4", "--json"], options].concat()));
        line["end"].as_str().expect("an end").to_owned()
    };
    let wall = |material: &str, more: &str| {
        format!(
            "materials.wall = {material}\n[[objects]]\n\
             shape = {{ rectangle = {{ origin = [-9, -9, 0], edge_u = [18, 0, 0], edge_v = [0, 18, 0] }} }}\n{more}"
        )
    };
    let named = "material = \"wall\"";
    let white = wall("{ lambertian = { albedo = 0.8 } }", named);
    let closed = "materials.wall.lambertian.albedo = 0.8\n[[objects]]\nshape.sphere = { center = [0, 0, 0], radius = 9 }\n\
                  material = \"wall\"\nflip = true\nemission.radiance = 1";
    for (expected, text, options) in [
        (End::LeftScene, "environment.radiance = 1", &[][..]),
        (End::LeftScene, &white, &["--roulette", "off"]),
        (End::Cap, &white, &["--max-bounces", "0"]),
        (End::NoMaterial, &wall("{ lambertian = { albedo = 0.8 } }", "emission.radiance = 1"), &[]),
        (
            End::BlackFromBehind,
            &wall("{ lambertian = { albedo = 0.8 }, two_sided = false }", "material = \"wall\"\nflip = true"),
            &[],
        ),
        (End::Black, &wall("{ lambertian = { albedo = 0.0 } }", named), &[]),
        (End::Roulette, &white, &["--roulette", "0.01"]),
        (End::Vanished, closed, &["--roulette", "off", "--estimator", "path"]),
    ] {
        let name = serde_json::json!(expected);
        assert_eq!(end(text, options), name.as_str().unwrap_or_default(), "{text} {options:?}");
    }
}

#[test]
fn lobes_are_named_with_their_probability() {
    let shell = Shell::new();
    // On the glass ball, reflection has Fresnel's reflectance as its probability, and the probabilities add up to 1.
    let head = "format = 1\ncamera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 20, resolution = [8, 8] }\nenvironment.radiance = 1\n\
                materials.ball = MATERIAL\n[[objects]]\nshape = { sphere = { center = [0, 0, 0], radius = 1 } }\nmaterial = \"ball\"\n";
    let first = |material: &str, sample: u32| {
        fs::write(shell.path("a.toml"), head.replace("MATERIAL", material)).expect("it is written");
        let line = json(&shell.run(&["render", "a.toml", "--pixel", "4,4", "--json", "--sample", &sample.to_string()]));
        line["vertices"][0]["reflection"].clone()
    };
    for (material, names) in [
        ("{ dielectric = { ior = 1.5 } }", ["mirror reflection", "refraction"]),
        ("{ plastic = { albedo = 0.5, ior = 1.5 } }", ["smooth coat", "diffuse base"]),
        (
            "{ dielectric = { ior = 1.5, roughness = 0.5, energy_compensation = false } }",
            ["microfacet reflection", "microfacet refraction"],
        ),
    ] {
        let mut seen = [0, 0];
        for sample in 0..60 {
            let reflection = first(material, sample);
            let name = reflection["lobe"]["name"].as_str().expect("a name");
            let which = names.iter().position(|known| *known == name).unwrap_or_else(|| panic!("{material}: {name}"));
            let probability = reflection["lobe"]["probability"].as_f64().expect("a number");
            assert_eq!(reflection["refracted"], name.contains("refraction"), "{reflection}");
            // At normal incidence Fresnel's reflectance is 4 %, which is the fraction of the coat.
            assert!(if which == 0 { (0.03..0.3).contains(&probability) } else { probability > 0.7 }, "{material}: {reflection}");
            seen[which] += 1;
        }
        assert!(seen[1] > seen[0], "{material}: {seen:?}");
    }
    assert_eq!(first("{ mirror = { reflectance = 0.9 } }", 0)["lobe"]["probability"], 1.0);
}

#[test]
fn samples_come_as_a_table_in_one_process_and_the_first_lit_one_is_found() {
    let shell = Shell::new();
    let small = ["--estimator", "path", "--sampler", "independent", "--reuse", "off"];
    let table = replay(&shell, "tiny_lamp", &[&small[..], &["--sample", "10-4999", "--csv", "-"]].concat());
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()).collect();
    assert_eq!((rows.len(), rows[0][0], rows[4989][0]), (4990, 10.0, 4999.0));
    let mean = rows.iter().map(|row| row[4]).sum::<f64>() / 4990.0;
    assert!((rows[4989][5] - mean).abs() <= 1e-9 * mean.abs(), "{mean} {:?}", rows[4989]);
    let written = |sampler: &str| {
        let few = ["--pixel", "20,30", "--sample", "0-9", "--csv", "a.csv", "--reuse", "off", "--sampler", sampler];
        let done = shell.run(&[&["render", &scene("tiny_lamp")], &few[..]].concat());
        assert!(done.status.success() && fs::read_to_string(shell.path("a.csv")).expect("a table").lines().count() == 11);
        text(&done.stderr)
    };
    assert_eq!(written("independent"), "");
    assert!(written("sobol").starts_with("warning: these samples are not independent"));

    let line = |sample: &str| {
        let output = shell.run(
            &[&["render", &scene("furnace"), "--pixel", "20,30", "--size", "64x64", "--json", "--sample", sample], &small[..]]
                .concat(),
        );
        json(&output)
    };
    assert_eq!(line("lit"), line("0"), "every sample of the furnace is lit");
    let lit = replay(&shell, "cornell_box", &[&small[..], &["--sample", "lit"]].concat());
    let number: u32 = lit.split("sample ").nth(1).and_then(|rest| rest.split(':').next()?.parse().ok()).expect("a number");
    let first = replay(&shell, "cornell_box", &[&small[..], &["--sample", &format!("0-{number}"), "--csv", "-"]].concat());
    let luminances: Vec<&str> = first.lines().skip(1).map(|line| line.split(',').nth(4).unwrap_or("")).collect();
    assert!(luminances[..number as usize].iter().all(|y| *y == "0") && luminances[number as usize] != "0", "{luminances:?}");
    let range = shell.run(&["render", &scene("furnace"), "--pixel", "1,1", "--sample", "0-9"]);
    assert!(range.status.code() == Some(1) && text(&range.stderr).contains("--csv FILE"), "{}", text(&range.stderr));
}
