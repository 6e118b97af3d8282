//! Repairs that are made without being asked for: what one round of them makes of a document, and whether less is left to repair
//! after it.

use super::{Document, Source};
use crate::drawing::DrawingEdit;
use crate::finding::{Edit, Finding, Fix, Rule, Severity};
use crate::text::{TextEdit, edited};

impl Document {
    /// One round of [`Document::fix_all`] as edits of the text, and the document after it; `None` where there is none, or it would
    /// leave as much to repair as before.
    pub fn round(&self) -> Option<(Vec<TextEdit>, Document)> {
        let settings = self.settings();
        if let Source::Program(program) = &self.source {
            let (edits, mended) = program.fixed(settings)?;
            let mended = Document::new(Source::Program(mended), settings.clone());
            return Some((edits, mended));
        }
        let (Edit::Drawing(edit), Source::Dxf(text)) = (self.fix_all()?, &self.source) else {
            return None;
        };
        let edits = text.text_edits(&edit).ok()?;
        let mended = self.reread(edited(text.text().bytes(), &edits)?);
        (mended.left_to_repair() < self.left_to_repair()).then_some((edits, mended))
    }

    /// The repair of a finding that is made without being asked for; of a drawing, if `may` holds for it.
    pub(crate) fn safe_fix(
        &self,
        finding: &Finding,
        may: &dyn Fn(&DrawingEdit) -> bool,
    ) -> Option<Fix<Edit>> {
        if let Some(drawing) = self.drawing() {
            let fix = self.analysis.safe_fix(drawing, finding, may)?;
            return Some(fix.map(Edit::Drawing));
        }
        let mut fixes = self.fixes(finding).into_iter();
        fixes.find(|fix| fix.preferred && fix.in_fix_all)
    }

    /// What each round of repairs of a drawing makes less: its findings, the heaviest ones first, else its segments.
    pub(crate) fn left_to_repair(&self) -> [usize; 5] {
        let findings = self.all_findings();
        let count = |severity| {
            let own = findings.iter().filter(|it| it.severity == severity);
            own.filter(|it| it.rule != Rule::NotTheDrawing).count()
        };
        let entities = self.drawing().into_iter().flat_map(|it| it.entities());
        let segments = entities.map(|(_, entity)| entity.geometry.segment_count());
        let [error, warning, information, hint] = [
            Severity::Error,
            Severity::Warning,
            Severity::Information,
            Severity::Hint,
        ]
        .map(count);
        [error, warning, information, hint, segments.sum()]
    }
}
