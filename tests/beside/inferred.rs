//! Programs without settings that were once said to differ from their drawings, or to have nothing in common with them.

use super::changes::{changed, line_of};
use super::{Shape, document, program_of, settings_of, traced};
use wedm::beside::compare;
use wedm::drawing::Role;
use wedm::program::Format;

/// A shape, its role, the format and the settings that its program was written with, and whether the drawing must be found in it.
type Row = (Shape, Role, Format, &'static str, bool);

fn slot([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Shape {
    Shape::Polyline(vec![
        [x, y, 0.0],
        [x + width, y, 1.0],
        [x + width, y + height, 0.0],
        [x, y + height, 1.0],
    ])
}

fn rows() -> Vec<Row> {
    vec![
        // A lead of another length was taken for another correction, under which most of so few blocks are off.
        (
            slot(
                [-4.747529631944, -0.90338012992],
                [8.0737788806725, 5.8067602598],
            ),
            Role::Opening,
            Format::Iso,
            "correction = 0.2\n[program]\ndirection = \"cw\"\nlead-in = 2.25\nlead = \"straight\"\n",
            false,
        ),
        (
            Shape::Circle([1.292642767415071, -6.7817777375241945], 12.0),
            Role::Punch,
            Format::ThreeB,
            "correction = 0.2\n[program]\ncorner = \"intersection\"\nlead-in = 2.25\nlead = \"straight\"\n",
            false,
        ),
        (
            Shape::Circle([2.342, 1.507], 5.827),
            Role::Punch,
            Format::Iso,
            "correction = 0.0875\n[program]\ndirection = \"cw\"\nlead-in = 2.25\nprofile = \"fast-wire\"\n",
            false,
        ),
        (
            slot(
                [0.165108794916, -1.1572462014564],
                [7.90582800118, 6.3144924029],
            ),
            Role::Opening,
            Format::ThreeB,
            "correction = 0.1\n[program]\ndirection = \"cw\"\nlead-in = 2.25\n",
            false,
        ),
        // Its round ends were named, each as far from its place as the other is.
        (
            slot(
                [-1.3749384118198114, -0.9486617964540796],
                [9.264373606013957, 5.897323592908158],
            ),
            Role::Opening,
            Format::ThreeB,
            "correction = 0.137\n[program]\ntab = 2\ndirection = \"cw\"\nlead-in = 2.25\nlead = \"straight\"\n",
            false,
        ),
        // Both ways of the wire were elsewhere by as much, and one of them was named.
        (
            slot([2.55, 0.017], [4.856, 3.966]),
            Role::Opening,
            Format::Iso,
            "correction = 0.1\n[program]\ndirection = \"cw\"\nlead = \"straight\"\nstart-hole = 1\nprofile = \"robofil\"\n",
            false,
        ),
        // A tenth of a micrometre of a correction moved one block by 2 µm.
        (
            Shape::Polyline(vec![
                [16.299, 6.377, 0.0],
                [4.336, 22.079, 0.3406281459922267],
                [-9.039, 16.837, 0.0],
                [-24.574, 13.613, -0.23831596161175478],
                [-18.942, -5.444, 0.0],
                [-7.244, -16.574, 0.013002918165090416],
                [5.186, -15.055, 0.0],
                [12.559, -4.712, 0.0],
            ]),
            Role::Opening,
            Format::Iso,
            "correction = 0.0875\n[program]\nlead = \"straight\"\n",
            true,
        ),
        (
            Shape::Polyline(vec![
                [11.717, 30.339, 0.2418669730101125],
                [-10.289, 26.028, -0.03664512491589955],
                [-17.576, -3.779, -0.08187434425774542],
                [12.648, -12.253, 0.0],
            ]),
            Role::Opening,
            Format::ThreeB,
            "[passes]\ncorrections = [0.191, 0.1212]\n[program]\nclosing-overlap = 1.5\nlead-in = 1.7\nlead = \"arc\"\nlayout = \"checking\"\n",
            false,
        ),
        // J of a circle is off by four times what its radius is off.
        (
            Shape::Circle([1.5905323306923371, -7.379123356854911], 5.0),
            Role::Opening,
            Format::ThreeB,
            "[passes]\ncorrections = [0.2321, 0.2176, 0.1811]\n[program]\nlead = \"straight\"\n",
            false,
        ),
        // A guess that is a tenth of a micrometre off has one of the ways of the wire elsewhere by a grid point.
        (
            slot(
                [-1.1946225053050674, -1.7151087380524843],
                [5.940942760020874, 7.430217476104968],
            ),
            Role::Opening,
            Format::Iso,
            "[passes]\ncorrections = [0.231, 0.2107, 0.16]\n[program]\nlead-in = 4\nlead = \"arc\"\n",
            false,
        ),
        (
            Shape::Polyline(vec![
                [31.551, 8.238, 0.0],
                [14.565, 12.049, 0.0],
                [9.714, 24.665, -0.17930930344798296],
                [-6.066, 26.618, -0.3219913327150464],
                [-9.379, 15.131, 0.0],
                [-22.08, 10.578, 0.0],
                [-25.306, -7.619, 0.2842509971885704],
                [-20.838, -14.796, 0.09449715123114688],
                [-8.374, -18.308, 0.0],
                [8.666, -17.7, 0.0],
                [11.094, -10.708, 0.0],
                [18.021, -5.233, 0.0],
            ]),
            Role::Opening,
            Format::FourB,
            "correction = 0.217\n[program]\nlead-in = 1.7\n",
            true,
        ),
        // A corner so sharp that it leads the second pass millimetres farther out: that was none of the same contour.
        (
            Shape::Polyline(vec![
                [36.924921, 14.460148, 0.0],
                [50.285078, 2.718044, 0.0],
                [46.50376, 6.418225, 0.0],
                [47.2499, 13.009929, 0.0],
            ]),
            Role::Opening,
            Format::ThreeB,
            "[passes]\ncorrections = [0.277, 0.104]\n[program]\ndirection = \"cw\"\ntab = 2.5\nlead = \"arc\"\nclosing-overlap = 0.5\n",
            true,
        ),
        // Nothing was alike: passes with corners of their own, a lead along an arc, passes of 4B.
        (
            Shape::Polyline(vec![
                [25.098, 3.855, 0.0],
                [11.06, 28.532, -0.21878160802245838],
                [-2.825, 24.247, -0.043259302697842006],
                [-18.051, 8.123, 0.0],
                [-26.08, -8.158, 0.03250074970580208],
                [-8.93, -11.268, -0.00019490514964853878],
                [3.319, -12.121, 0.2571577425769228],
                [16.63, -0.888, 0.0],
            ]),
            Role::Opening,
            Format::ThreeB,
            "[passes]\ncorrections = [0.215, 0.17, 0.14]\nskim-corner = \"constant-stock\"\n[program]\nlead-in = 1.7\nlayout = \"checking\"\n",
            true,
        ),
        (
            Shape::Circle([-9.948, -2.234], 8.0),
            Role::Punch,
            Format::ThreeB,
            "correction = 0.155\n[program]\nlead-in = 1.7\nlead = \"arc\"\n",
            true,
        ),
        (
            Shape::Polyline(vec![
                [18.256, 8.487, 0.0],
                [-5.678, 20.419, 0.0],
                [-24.99, 5.371, 0.0],
                [-3.074, -16.905, 0.0],
                [8.155, -8.637, 0.0],
            ]),
            Role::Opening,
            Format::FourB,
            "[passes]\ncorrections = [0.2159, 0.1626, 0.1473]\nsequence = \"one-way\"\n[program]\ndirection = \"cw\"\n",
            true,
        ),
        (
            Shape::Polyline(vec![
                [31.23, 6.548, 0.18450159153775525],
                [23.958, 24.479, -0.10726212617736716],
                [-8.389, 29.065, 0.0],
                [-14.085, 16.129, 0.15661429962085127],
                [-21.884, -10.724, -0.03401110287891734],
                [-2.746, -13.733, 0.0],
                [12.328, -11.415, 0.24073837660976682],
                [23.164, -11.989, 0.0],
            ]),
            Role::Opening,
            Format::Iso,
            "[passes]\ncorrections = [0.2, 0.15]\nskim-corner = \"constant-stock\"\n[program]\nlead = \"arc\"\n",
            true,
        ),
        // The control counts from the thread hole, which lies a hair beside the drawing's origin.
        (
            Shape::Polyline(vec![
                [-1.35, -0.739756, 0.0],
                [1.35, -0.739756, 0.41421356],
                [1.5, -0.589756, 0.0],
                [1.5, 0.589756, 0.41421356],
                [1.35, 0.739756, 0.0],
                [-1.35, 0.739756, 0.41421356],
                [-1.5, 0.589756, 0.0],
                [-1.5, -0.589756, 0.41421356],
            ]),
            Role::Opening,
            Format::Iso,
            "[program]\nprofile = \"robofil\"\n",
            false,
        ),
        // Its centre is the origin, from which and from the start of the arc the numbers are as many.
        (
            Shape::Circle([0.0, 0.0], 3.0),
            Role::Opening,
            Format::Iso,
            "correction = 0.125\n[program]\nprofile = \"robofil\"\n",
            false,
        ),
        // The length of its way in is that to a start hole.
        (
            Shape::Polyline(vec![
                [-7.174865, -5.130121, 0.0],
                [6.817366, -5.596458, 0.41421356],
                [7.850121, -4.630323, 0.0],
                [8.141, 4.097366, 0.41421356],
                [7.174865, 5.130121, 0.0],
                [-6.817366, 5.596458, 0.41421356],
                [-7.850121, 4.630323, 0.0],
                [-8.141, -4.097366, 0.41421356],
            ]),
            Role::Opening,
            Format::ThreeB,
            "correction = 0.18\n[program]\nstart-hole = 0.5\n",
            true,
        ),
        // Arcs of the drawing smaller than the transitions of 4B, which tell of its correction.
        (
            Shape::Polyline(vec![
                [16.0, -5.658, 0.0],
                [19.0, -5.658, 1.0],
                [19.0, -5.558, 0.0],
                [17.5, 4.342, 0.0],
                [8.0, 3.0, 0.0],
            ]),
            Role::Punch,
            Format::FourB,
            "correction = 0.125\n[program]\nlead = \"straight\"\n",
            true,
        ),
        // The correction of 4B and a tab were both unknown.
        (
            Shape::Polyline(vec![
                [3.00105, 0.301109, 0.0],
                [0.424266, 1.950696, 0.0],
                [-2.125838, 1.240768, 0.0],
                [-2.238884, -1.996847, 0.0],
                [1.127363, -2.564608, 0.0],
            ]),
            Role::Punch,
            Format::FourB,
            "correction = 0.08\n[program]\ntab = 0.5\n",
            true,
        ),
        // It has no transitions: only its ways in and out tell the correction of 4B.
        (
            Shape::Polyline(vec![
                [-7.8, -5.800751, 0.0],
                [7.8, -5.800751, 0.41421356],
                [8.0, -5.600751, 0.0],
                [8.0, 5.600751, 0.41421356],
                [7.8, 5.800751, 0.0],
                [-7.8, 5.800751, 0.41421356],
                [-8.0, 5.600751, 0.0],
                [-8.0, -5.600751, 0.41421356],
            ]),
            Role::Opening,
            Format::FourB,
            "correction = 0.125\n",
            true,
        ),
        // One of so few blocks is a fourth of them.
        (
            Shape::Circle([0.0, 0.0], 20.0),
            Role::Opening,
            Format::Iso,
            "correction = 0.125\n[program]\nstart-hole = 2\n",
            true,
        ),
        // How far the wire goes aside at the tab tells the correction of each pass, not that of the first alone.
        (
            Shape::Polyline(vec![
                [10.8, 1.142, 0.0],
                [10.8, -8.558, -0.41421356],
                [10.2, -9.158, 0.0],
                [1.2, -9.158, -0.41421356],
                [-0.8, -7.158, 0.0],
                [-0.8, 2.542, -0.41421356],
                [-0.1, 3.242, 0.0],
                [8.7, 3.242, -0.41421356],
            ]),
            Role::Punch,
            Format::Iso,
            "[passes]\ncorrections = [0.25, 0.155, 0.13]\nsequence = \"one-way\"\n[program]\ndirection = \"cw\"\ntab = 3\nlead = \"arc\"\ncompensation = \"controller\"\n",
            true,
        ),
    ]
}

/// Of what is unchanged nothing is reported; where the drawing is found in it, a block in its middle that is changed by 3 µm is named, and no other.
#[test]
fn without_settings_what_a_program_shows_is_taken_for_its_settings() {
    let settings = settings_of("");
    // All rows where `WEDM_CASES` is set, else some.
    let step = if std::env::var("WEDM_CASES").is_ok() {
        1
    } else {
        5
    };
    for (shape, role, format, written, is_found) in rows().into_iter().step_by(step) {
        let made = document(&[(shape.clone(), role)], &settings_of(written));
        let text = program_of(&made, format).unwrap();
        let drawn = document(&[(shape, Role::Both)], &settings);
        let drawn = drawn.drawn().unwrap();
        let found = compare(&drawn, &traced(&text, format, &settings));
        assert!(found.is_some() || !is_found, "{written}\n{text}");
        let Some(found) = found else { continue };
        assert_eq!(found.differences, [], "{written}\n{text}");
        let block = &found.follows[found.follows.len() / 2];
        if let Some(wrong) = changed(&text, block, 3, 0).filter(|_| is_found) {
            let told = compare(&drawn, &traced(&wrong, format, &settings));
            let lines = told.iter().flat_map(|told| &told.differences);
            let lines: Vec<usize> = lines.map(|one| one.line).collect();
            assert_eq!(lines, [line_of(&text, block.start)], "{written}\n{wrong}");
        }
    }
}
