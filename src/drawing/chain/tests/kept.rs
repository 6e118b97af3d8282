//! Contours that an edit leaves as they were.

use super::*;

/// Outlines that touch each other in their corners are one group. Without a line of one of them the others are what they were.
#[test]
fn contours_of_a_group_that_come_out_as_they_were_keep_their_keys() {
    let outline = |number: u32| {
        let at = f64::from(number);
        let corners = [(0.0, 0.0), (0.6, 0.0), (1.0, 0.4), (1.0, 1.0), (0.0, 1.0)];
        let ends = corners.into_iter().zip(corners.into_iter().cycle().skip(1));
        ends.map(move |((x0, y0), (x1, y1))| (at + x0, at + y0, at + x1, at + y1))
    };
    let all: Vec<Coordinates> = (0..5).flat_map(outline).collect();
    let mut drawing = lines(&all);
    let mut chains = Chains::new(&drawing, 0.01, &|_| true);
    let keys = |chains: &Chains| -> Vec<Key> {
        let key = |number: u32| chains.contour_of(EntityId(5 * number)).unwrap();
        (0..5).map(key).collect()
    };
    let before = keys(&chains);
    assert!(before.iter().all(|&key| chains.get(key).unwrap().closed));
    assert!(before.iter().all(|&key| !chains.stands_alone(key)));
    drawing.remove(EntityId(11));
    let rechained = chains.update(&drawing, &[EntityId(11)], &|_| true);
    let after = keys(&chains);
    assert_eq!(
        (rechained.gone, rechained.new),
        (vec![before[2]], vec![after[2]])
    );
    assert_eq!(rechained.chained, 24);
    let stays = |number: &usize| after[*number] == before[*number];
    assert_eq!((0..5).filter(stays).collect::<Vec<usize>>(), [0, 1, 3, 4]);
}
