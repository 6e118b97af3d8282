//! A picture as PNG, for programs that show no SVG.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Pixels for each unit of the sheet: legible on a printed page and on a dense screen.
const PIXELS_PER_UNIT: f32 = 2.0;

/// Paints `svg`, one of ours, in the colours of a light viewer.
///
/// Texts are set in a font of this machine.
///
/// # Errors
/// A sentence where the machine has no font, or the picture is too large to be painted: nothing is left out in silence.
pub fn png(svg: &str) -> Result<Vec<u8>, String> {
    let mut options = Options::default();
    options.fontdb_mut().load_system_fonts();
    if options.fontdb.is_empty() {
        return Err("there is no font on this machine for the texts of the picture: install one, or write .svg".into());
    }
    set_generic_families(&mut options);
    let tree = Tree::from_str(svg, &options).map_err(|fault| format!("the picture cannot be painted: {fault}"))?;
    let size = tree.size().to_int_size().scale_by(PIXELS_PER_UNIT);
    let mut sheet = size
        .and_then(|size| Pixmap::new(size.width(), size.height()))
        .ok_or_else(|| format!("a picture of {} by {} is too large to be painted", tree.size().width(), tree.size().height()))?;
    resvg::render(&tree, Transform::from_scale(PIXELS_PER_UNIT, PIXELS_PER_UNIT), &mut sheet.as_mut());
    sheet.encode_png().map_err(|fault| format!("the picture cannot be written as PNG: {fault}"))
}

/// Any font of the machine stands in where none of the named ones is there: a text in another font is better than none.
fn set_generic_families(options: &mut Options<'_>) {
    let preferred = ["DejaVu Sans", "Liberation Sans", "Noto Sans", "Arial", "Helvetica"];
    let fonts = options.fontdb_mut();
    let has = |name: &str| fonts.faces().any(|face| face.families.iter().any(|(family, _)| family == name));
    let first = || fonts.faces().next().and_then(|face| face.families.first()).map(|(family, _)| family.clone());
    let family = preferred.into_iter().find(|name| has(name)).map(String::from).or_else(first);
    if let Some(family) = family {
        fonts.set_sans_serif_family(family.clone());
        options.font_family = family;
    }
}
