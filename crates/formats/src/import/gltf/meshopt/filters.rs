//! Filters of meshopt, which undo how numbers were packed. Each returns whether it applies.

/// Unit directions: on an octahedron, with the length of its axes in the third number. The fourth stays as it is.
pub fn octahedral(bytes: &mut [u8], stride: usize) -> bool {
    for element in bytes.chunks_exact_mut(stride) {
        match element {
            [x, y, z, _] => {
                let unit = direction([*x, *y, *z].map(|code| f32::from(code as i8)), 127.0);
                [*x, *y, *z] = unit.map(|x| x as i8 as u8);
            }
            _ => {
                let unit = direction([0, 1, 2].map(|place| f32::from(short(element, place))), 32767.0);
                unit.into_iter().enumerate().for_each(|(place, x)| set_short(element, place, x as i16));
            }
        }
    }
    true
}

/// The unit direction of a point on an octahedron, times `most`, in whole numbers.
fn direction([x, y, one]: [f32; 3], most: f32) -> [f32; 3] {
    let z = one - x.abs() - y.abs();
    let fold = z.min(0.0);
    let [x, y] = [x, y].map(|x| if x >= 0.0 { x + fold } else { x - fold });
    let scale = most / (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|x| rounded(x * scale))
}

/// Unit quaternions: the three numbers of the smallest magnitude, and in the last the place of the fourth and the scale of the others.
pub fn quaternions(bytes: &mut [u8]) -> bool {
    const MOST: f32 = 32767.0;
    for element in bytes.chunks_exact_mut(8) {
        let last = short(element, 3);
        let scale = std::f32::consts::FRAC_1_SQRT_2 / f32::from(last | 3);
        let small = [0, 1, 2].map(|place| f32::from(short(element, place)) * scale);
        let large = (1.0 - small.iter().map(|x| x * x).sum::<f32>()).max(0.0).sqrt();
        for (step, x) in [large, small[0], small[1], small[2]].into_iter().enumerate() {
            set_short(element, ((last & 3) as usize + step) % 4, rounded(x * MOST) as i16);
        }
    }
    true
}

/// Numbers as a mantissa of 24 bits below an exponent of 8.
pub fn exponential(bytes: &mut [u8]) -> bool {
    for number in bytes.as_chunks_mut::<4>().0 {
        let code = i32::from_le_bytes(*number);
        let (mantissa, exponent) = ((code << 8) >> 8, code >> 24);
        *number = ((f64::from(mantissa) * 2f64.powi(exponent)) as f32).to_le_bytes();
    }
    true
}

/// Colours as brightness and two differences, with the number of bits as the highest bit of the fourth number.
pub fn colours(bytes: &mut [u8], stride: usize) -> bool {
    for element in bytes.chunks_exact_mut(stride) {
        match element {
            [y, orange, green, alpha] => {
                let differences = [*orange, *green].map(|x| i32::from(x as i8));
                let colour = colour(i32::from(*y), differences, u32::from(*alpha), 255.0);
                [*y, *orange, *green, *alpha] = colour.map(|x| x as u8);
            }
            _ => {
                let [y, alpha] = [0, 3].map(|place| short(element, place) as u16);
                let differences = [1, 2].map(|place| i32::from(short(element, place)));
                let colour = colour(y.into(), differences, alpha.into(), 65535.0);
                colour.into_iter().enumerate().for_each(|(place, x)| set_short(element, place, x as u16 as i16));
            }
        }
    }
    true
}

/// Red, green, blue and alpha of a colour, up to `most`.
fn colour(y: i32, [orange, green]: [i32; 2], alpha: u32, most: f32) -> [f32; 4] {
    let Some(highest) = alpha.checked_ilog2() else { return [0.0; 4] };
    let one = (2 << highest) - 1;
    // Alpha has a bit less than the others, and repeats its last one.
    let alpha = alpha as i32 & (one >> 1);
    let numbers = [y + orange - green, y + green, y - orange - green, alpha << 1 | alpha & 1];
    numbers.map(|x| rounded(x as f32 * (most / one as f32)))
}

/// The nearest whole number, of two the one away from 0.
fn rounded(x: f32) -> f32 {
    (x + 0.5f32.copysign(x)).trunc()
}

fn short(element: &[u8], place: usize) -> i16 {
    i16::from_le_bytes([element[2 * place], element[2 * place + 1]])
}

fn set_short(element: &mut [u8], place: usize, x: i16) {
    element[2 * place..2 * place + 2].copy_from_slice(&x.to_le_bytes());
}
