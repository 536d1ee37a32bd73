//! Names of GPU objects, as debuggers show them.

/// What the labels of a pass's objects begin with: the descriptor's label, or the type's name.
#[derive(Clone, Debug)]
pub(crate) struct Label(String);

impl Label {
    pub(crate) fn new(given: Option<&str>, type_name: &str) -> Self {
        Self(given.unwrap_or(type_name).to_owned())
    }

    /// The beginning alone: the label of the pass as it is recorded.
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }

    /// The label of one object: `SubsurfacePass bind group`.
    pub(crate) fn of(&self, object: &str) -> String {
        format!("{} {object}", self.0)
    }
}
