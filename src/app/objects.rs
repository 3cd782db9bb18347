//! The objects, prepared for rays once for the whole program.

use std::sync::{Arc, OnceLock};

use crate::scene::{Object, Target};

const COUNT: usize = Object::ALL.len();

/// An object prepared for rays; made when it is first asked for.
pub fn target_of(object: Object) -> Arc<Target> {
    static TARGETS: [OnceLock<Arc<Target>>; COUNT] = [const { OnceLock::new() }; COUNT];
    let make = || Arc::new(Target::new(object.mesh()));
    match Object::ALL.iter().position(|o| *o == object) {
        Some(index) => Arc::clone(TARGETS[index].get_or_init(make)),
        None => make(),
    }
}

/// Prepares every object on a thread of its own, so that the window need not wait for one that is chosen later.
pub fn prepare_all() {
    // Without a thread they are made when they are asked for.
    drop(std::thread::Builder::new().spawn(|| {
        for object in Object::ALL {
            drop(target_of(object));
        }
    }));
}
