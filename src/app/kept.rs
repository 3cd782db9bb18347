//! What was found for a frame and holds for the next ones.

use std::sync::Arc;

use egui::{Id, Ui};

/// What `find` finds for a key, found anew only where the last frame's key under that id was another.
pub fn kept<K, V>(ui: &Ui, id: Id, key: K, find: impl FnOnce() -> V) -> Arc<V>
where
    K: Clone + PartialEq + Send + Sync + 'static,
    V: Send + Sync + 'static,
{
    let last = ui.data(|data| data.get_temp::<(K, Arc<V>)>(id));
    if let Some((_, found)) = last.filter(|(of, _)| *of == key) {
        return found;
    }
    let found = Arc::new(find());
    ui.data_mut(|data| data.insert_temp(id, (key, Arc::clone(&found))));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_found_once_for_a_key() {
        let mut times = 0;
        let mut of = |ui: &Ui, key: u32| {
            *kept(ui, Id::unique("test"), key, || {
                times += 1;
                2 * key
            })
        };
        egui::__run_test_ui(|ui| {
            assert_eq!([of(ui, 1), of(ui, 1), of(ui, 2), of(ui, 1)], [2, 2, 4, 2]);
        });
        assert_eq!(times, 3, "1, 2, and 1 again, since only the last is kept");
    }
}
