//! Entities drawn only to be read, not to be cut, recognised by the names of linetype and layer.
//!
//! A name counts only where every word of it is listed here: CENTER_HOLES is a layer of holes. Case does not matter.

use std::cell::RefCell;
use std::sync::Arc;

/// The beginnings of the names of broken lines: ISO 128 as AutoCAD, LibreCAD, QCAD, JIS, ANSI and the DIN templates
/// name them, and as their German, French, Italian, Spanish, Portuguese and Russian versions do.
const LINETYPES: &[&str] = &[
    "acad_iso",
    "achse",
    "am_iso",
    "axe",
    "cache",
    "center",
    "centre",
    "centro",
    "chain",
    "dash",
    "divide",
    "fantasma",
    "fantom",
    "gestrichelt",
    "hidden",
    "interromp",
    "jis_",
    "long_dash",
    "mitte",
    "nascosta",
    "oculta",
    "phantom",
    "strich",
    "tiret",
    "tracejad",
    "tratt",
    "trazo",
    "verdeckt",
    "невидим",
    "осев",
    "штрих",
];

/// Parts of the Chinese and Japanese names of such lines.
const LINETYPES_IN_HAN: &[&str] = &[
    "中心", "虚线", "虛線", "点划", "点画", "點劃", "點畫", "隐藏", "隱藏", "假想", "鎖線", "破線",
];

/// The layer of thread holes: they are drilled.
pub(crate) const START_HOLES: &str = "START-HOLES";

/// Parts of the names of layers with start holes, letters and digits alone.
const START_HOLE_LAYERS: &[&str] = &[
    "startbohrung",
    "starthole",
    "startloch",
    "startpoint",
    "threadhole",
    "threadinghole",
    "wirehole",
    "穿丝",
    "穿絲",
    "ワイヤ穴",
];

/// True for the name of a layer with start holes.
pub(crate) fn is_layer_of_start_holes(name: &str) -> bool {
    let letters = name.chars().filter(|letter| letter.is_alphanumeric());
    let own: String = letters.collect::<String>().to_lowercase();
    START_HOLE_LAYERS.iter().any(|part| own.contains(part))
}

/// The layers on which the CAD plugins draw marks about faults and the wire's path.
const OF_PLUGINS: &[&str] = &["WEDM_MARKS", "WEDM_PATH"];

/// The layers of the ways to and between contours in a drawing that is made from a program.
const OF_WAYS: &[&str] = &["LEAD", "WAY"];

/// Words of layers with centre marks, hatches, dimensions, texts and construction lines; sorted.
const LAYERS: &[&str] = &[
    "achse",
    "achsen",
    "anno",
    "annotation",
    "annotations",
    "assi",
    "axe",
    "axes",
    "axis",
    "bemassung",
    "bemassungen",
    "bemaßung",
    "beschriftung",
    "center",
    "centers",
    "centre",
    "centres",
    "cl",
    "constr",
    "construction",
    "costruzione",
    "cota",
    "cotas",
    "cotation",
    "cote",
    "cotes",
    "dim",
    "dimension",
    "dimensioning",
    "dimensions",
    "dims",
    "ejes",
    "hachure",
    "hachures",
    "hatch",
    "hatches",
    "hatching",
    "hidden",
    "hilfs",
    "hilfsgeometrie",
    "konstruktion",
    "leader",
    "leaders",
    "mass",
    "maß",
    "maße",
    "mitte",
    "mittel",
    "mittellinie",
    "note",
    "notes",
    "patt",
    "phantom",
    "quota",
    "quotatura",
    "quote",
    "schraffur",
    "schraffuren",
    "strichpunkt",
    "symmetrie",
    "symmetry",
    "text",
    "texte",
    "texts",
    "verdeckt",
    "verdeckte",
    "viewport",
    "viewports",
];

/// Words that do not describe the content of a layer; also the second half of one word, as in CENTERLINES.
const FILLERS: &[&str] = &[
    "geometrie",
    "geometry",
    "iso",
    "kanten",
    "layer",
    "line",
    "linea",
    "linee",
    "lines",
    "linie",
    "linien",
    "mark",
    "marker",
    "marks",
];

/// The same in Chinese and Japanese, within a name.
const LAYERS_IN_HAN: &[&str] = &[
    "中心线",
    "中心線",
    "标注",
    "標註",
    "尺寸",
    "剖面线",
    "剖面線",
    "辅助线",
    "輔助線",
    "构造线",
    "構造線",
    "虚线",
    "虛線",
    "点划线",
    "点画线",
    "隐藏线",
    "隱藏線",
    "文字",
    "寸法",
    "補助線",
    "ハッチング",
];

/// Layers of AutoCAD Mechanical: hidden lines, dimensions, texts, centre lines, hatches.
const OF_MECHANICAL: &[&str] = &["am_3", "am_5", "am_6", "am_7", "am_8"];

/// True for the name of a linetype of centre lines, hidden edges or construction.
pub(crate) fn is_drafting_linetype(name: &str) -> bool {
    // A name that came with another drawing is prefixed with that drawing's name.
    let own = name.rsplit(['$', '|']).next().unwrap_or(name);
    let own = own.to_lowercase();
    LINETYPES.iter().any(|begin| own.starts_with(begin))
        || LINETYPES_IN_HAN.iter().any(|part| own.contains(part))
}

/// The name of a layer, and whether it is one of these.
type Asked = Option<(Arc<str>, bool)>;

thread_local! {
    /// The layers looked up last: thousands of entities lie on one.
    static ASKED: RefCell<[Asked; 8]> = const { RefCell::new([const { None }; 8]) };
}

/// True for the name of a layer on which `wedm convert` draws ways to and between contours, each of a single segment: an outline on
/// a layer of that name is somebody's own.
pub(crate) fn is_layer_of_ways(name: &str) -> bool {
    OF_WAYS.contains(&name)
}

/// True for the name of a layer with annotation of the part: as ISO 13567 writes it, or in words.
pub(crate) fn is_drafting_layer(name: &Arc<str>) -> bool {
    ASKED.with_borrow_mut(|asked| {
        let of_name = |it: &Asked| {
            let (known, answer) = it.as_ref()?;
            Arc::ptr_eq(known, name).then_some(*answer)
        };
        asked.iter().find_map(of_name).unwrap_or_else(|| {
            let answer = is_drafting_name(name);
            asked.rotate_right(1);
            asked[0] = Some((name.clone(), answer));
            answer
        })
    })
}

fn is_drafting_name(name: &str) -> bool {
    let own = name.rsplit(['$', '|']).next().unwrap_or(name);
    if own.is_ascii() {
        return own.eq_ignore_ascii_case(START_HOLES)
            || is_iso_13567(own)
            || OF_MECHANICAL
                .iter()
                .chain(OF_PLUGINS)
                .any(|layer| layer.eq_ignore_ascii_case(own))
            || is_of_words(own);
    }
    LAYERS_IN_HAN.iter().any(|part| own.contains(part)) || is_of_words(&own.to_lowercase())
}

/// Agent responsible (2), element (6), presentation (2), …: `A-B374--D-`. Presentations are annotation, dimensions,
/// texts, hatches, section marks, revision marks.
fn is_iso_13567(name: &str) -> bool {
    let bytes = name.as_bytes();
    let is_code = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_');
    bytes.len() >= 10
        && bytes.iter().take(10).all(is_code)
        && bytes[0].is_ascii_alphabetic()
        && bytes[1] == b'-'
        && matches!(
            bytes[8].to_ascii_uppercase(),
            b'A' | b'D' | b'H' | b'J' | b'K' | b'T'
        )
        && !bytes[9].is_ascii_alphabetic()
}

fn is_of_words(name: &str) -> bool {
    let is_filler = |word: &str| {
        FILLERS
            .iter()
            .any(|filler| filler.eq_ignore_ascii_case(word))
    };
    let is_word = |word: &[u8]| {
        LAYERS
            .binary_search_by(|known| known.bytes().cmp(word.to_ascii_lowercase()))
            .is_ok()
    };
    // MITTELLINIEN is a word and a filler.
    let is_known = |word: &str| {
        let word = word.as_bytes();
        let stem = |filler: &str| {
            let (stem, end) = word.split_at_checked(word.len().checked_sub(filler.len())?)?;
            end.eq_ignore_ascii_case(filler.as_bytes()).then_some(stem)
        };
        is_word(word)
            || FILLERS
                .iter()
                .any(|filler| stem(filler).is_some_and(is_word))
    };
    let mut says_it = false;
    let words = name
        .split(|letter: char| !letter.is_alphanumeric())
        .map(|word| word.trim_matches(|letter: char| letter.is_ascii_digit()))
        .filter(|word| word.chars().nth(1).is_some());
    for word in words {
        if is_known(word) {
            says_it = true;
        } else if !is_filler(word) {
            return false;
        }
    }
    says_it
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_sorted() {
        assert!(
            LAYERS.is_sorted(),
            "{:?}",
            LAYERS.windows(2).find(|pair| pair[0] > pair[1])
        );
    }

    #[test]
    fn linetypes() {
        for name in [
            "CENTER",
            "center2",
            "CENTERX2",
            "HIDDEN",
            "HIDDEN2",
            "PHANTOM2",
            "DASHDOT",
            "DASHED",
            "ACAD_ISO04W100",
            "ACAD_ISO10W100",
            "AM_ISO08W050",
            "JIS_08_15",
            "JIS_02_1.0",
            "MITTE",
            "Mittellinie",
            "STRICHPUNKT2",
            "VERDECKT",
            "GESTRICHELT",
            "AXES",
            "CENTRO",
            "中心线",
            "点划线",
            "虚线",
            "PLATE$0$CENTER",
            "Plate|HIDDEN",
            "ШТРИХПУНКТИРНАЯ",
        ] {
            assert!(is_drafting_linetype(name), "{name}");
        }
        for name in [
            "CONTINUOUS",
            "Continuous",
            "BYLAYER",
            "BORDER",
            "DOT",
            "",
            "SOLID",
            "DIE",
            "ZIGZAG",
        ] {
            assert!(!is_drafting_linetype(name), "{name}");
        }
    }

    #[test]
    fn layers() {
        for name in [
            "CENTER",
            "Center Lines",
            "CENTERLINES",
            "CENTER_MARK",
            "DIM",
            "dims-2",
            "A-ANNO-DIMS",
            "DIM_TEXT",
            "Bemassung",
            "BEMASSUNG",
            "Bemaßung",
            "Mittellinien",
            "Hilfslinien",
            "SCHRAFFUR",
            "Maßlinien",
            "MASSLINIEN",
            "HATCH",
            "Construction",
            "Axes",
            "COTES",
            "标注",
            "尺寸线",
            "中心线层",
            "A-B374--D-",
            "M-41----T-N01",
            "AM_7",
            "START-HOLES",
            "WEDM_MARKS",
            "WEDM_PATH",
            "PLATE$0$DIM",
        ] {
            assert!(is_drafting_name(name), "{name}");
        }
        for name in [
            "0",
            "DIE",
            "PUNCH",
            "CENTER_HOLES",
            "HOLES",
            "CENTERPUNCH",
            "OUTLINE",
            "LINES",
            "Layer 1",
            "AM_0",
            "AM_1",
            "A-B374--E-",
            "STEMPEL-AUSSEN",
            "DIMPLE",
            "",
            "-",
            "7",
            "TEXTURE",
            "图层1",
            "凸模",
            "Defpoints",
        ] {
            assert!(!is_drafting_name(name), "{name}");
        }
    }
}
