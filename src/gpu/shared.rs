//! Large data that a frame shares with whoever made it.

use std::ops::Deref;
use std::sync::Arc;

/// Shared data, equal only to itself: comparing two frames never looks into a mesh or a picture.
#[derive(Debug)]
pub struct Shared<T>(Arc<T>);

impl<T> Shared<T> {
    /// Takes the data.
    pub fn new(data: T) -> Self {
        Self(Arc::new(data))
    }
}

impl<T> From<Arc<T>> for Shared<T> {
    fn from(data: Arc<T>) -> Self {
        Self(data)
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> Deref for Shared<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
