//! A picture as a file of another kind: PNG to paste, PDF to print.
//!
//! Its texts are turned into outlines. The program carries `font/wedm.ttf`, so that the same drawing gives the same
//! picture on every machine: WenQuanYi Micro Hei under the Apache License 2.0, cut down by `font/make` to the
//! characters of all sentences in every language, of western texts and the most used of Chinese. Characters that it
//! lacks, such as those of a file name, come from the fonts of the machine.

use super::style::without_dark;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, WriteOptions, fontdb};
use std::sync::Arc;

const FONT: &[u8] = include_bytes!("font/wedm.ttf");
/// The characters that the font has.
const CHARACTERS: &str = include_str!("font/characters.txt");
const FAMILY: &str = "WenQuanYi Micro Hei";
/// Pixels of a PNG for each unit of the sheet: sharp on paper at 200 dpi, and on dense screens.
const PIXELS: f32 = 2.0;
/// Units of the sheet in an inch, as many as CSS has pixels.
const DPI: f32 = 96.0;

/// The formats of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Image {
    Svg,
    Png,
    Pdf,
}

impl Image {
    /// By the ending of a file's name, in either letter case.
    pub(crate) fn of_ending(ending: &str) -> Option<Image> {
        match ending.to_ascii_lowercase().as_str() {
            "svg" => Some(Image::Svg),
            "png" => Some(Image::Png),
            "pdf" => Some(Image::Pdf),
            _ => None,
        }
    }

    /// The bytes of a file with this picture, in light colours, whatever the machine uses.
    ///
    /// # Errors
    /// A sentence: it is not a picture, or larger than can be drawn.
    pub(crate) fn of_svg(self, svg: &str) -> Result<Vec<u8>, String> {
        let failed = |error: String| say!(the_picture_cannot_be_written, error);
        match self {
            Image::Svg => Ok(svg.into()),
            Image::Png => {
                let tree = tree(svg).map_err(|error| failed(error.to_string()))?;
                let size = tree.size().to_int_size().scale_by(PIXELS);
                let mut pixels = size
                    .and_then(|size| Pixmap::new(size.width(), size.height()))
                    .ok_or_else(|| failed(say!(it_is_too_large).into()))?;
                let scale = Transform::from_scale(PIXELS, PIXELS);
                resvg::render(&tree, scale, &mut pixels.as_mut());
                pixels
                    .encode_png()
                    .map_err(|error| failed(error.to_string()))
            }
            Image::Pdf => {
                let tree = tree(svg).map_err(|error| failed(error.to_string()))?;
                // Texts are outlines from here on.
                let outlined = tree.to_string(&WriteOptions::default());
                let tree = Tree::from_str(&outlined, &Options::default())
                    .map_err(|error| failed(error.to_string()))?;
                let page = svg2pdf::PageOptions { dpi: DPI };
                svg2pdf::to_pdf(&tree, svg2pdf::ConversionOptions::default(), page)
                    .map_err(|error| failed(error.to_string()))
            }
        }
    }
}

fn tree(svg: &str) -> Result<Tree, resvg::usvg::Error> {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    if !svg.chars().all(has) {
        fonts.load_system_fonts();
    }
    fonts.set_sans_serif_family(FAMILY);
    let options = Options {
        font_family: FAMILY.into(),
        fontdb: Arc::new(fonts),
        ..Options::default()
    };
    Tree::from_str(&without_dark(svg), &options)
}

fn has(character: char) -> bool {
    character.is_ascii() || CHARACTERS.contains(character)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every sentence, in every language; `font/make` makes the font again.
    #[test]
    fn the_font_has_every_character_that_is_said() {
        for entry in walkdir::WalkDir::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src/message")) {
            let path = entry.unwrap().into_path();
            let is_language = path
                .parent()
                .is_some_and(|folder| !folder.ends_with("message"));
            if path.is_file() && is_language {
                let text = std::fs::read_to_string(&path).unwrap();
                let lacking: String = text.chars().filter(|&it| !has(it)).collect();
                assert_eq!(lacking, "", "{}", path.display());
            }
        }
    }

    #[test]
    fn texts_of_every_language_are_seen_in_every_form() {
        let sheet = |text: &str| {
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"40\" viewBox=\"0 0 200 40\">\
                 <style>text{{font-family:system-ui,Arial,sans-serif;font-size:20px;fill:#000}}\
                 @media (prefers-color-scheme:dark){{\ntext{{fill:#fff}}\n}}\n</style>\
                 <text x=\"4\" y=\"28\">{text}</text></svg>"
            )
        };
        let inked = |text: &str| {
            let png = Image::Png.of_svg(&sheet(text)).unwrap();
            let pixels = Pixmap::decode_png(&png).unwrap();
            assert_eq!((pixels.width(), pixels.height()), (400, 80));
            pixels.pixels().iter().filter(|it| it.alpha() > 128).count()
        };
        assert_eq!(inked(""), 0);
        for text in ["wire", "穿丝孔", "µm ± ø"] {
            assert!(inked(text) > 100, "{text}");
        }
        let pdf = Image::Pdf.of_svg(&sheet("穿丝孔")).unwrap();
        assert!(
            pdf.starts_with(b"%PDF-") && pdf.len() > 800,
            "{}",
            pdf.len()
        );
        assert!(Image::Png.of_svg("no picture").is_err());
    }
}
