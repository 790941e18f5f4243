use brinell::parts::each;

#[test]
fn the_results_come_in_the_order_of_the_items() {
    let items: Vec<u32> = (0..100).collect();
    assert_eq!(each(&items, |item| Ok::<_, ()>(2 * item)), Ok(items.iter().map(|item| 2 * item).collect()));
    assert_eq!(each(&[] as &[u32], |_| Ok::<u32, ()>(0)), Ok(Vec::new()));
}

#[test]
fn the_first_error_is_given() {
    let items: Vec<u32> = (0..100).collect();
    let odd_ones_fail = |item: &u32| if item % 2 == 1 { Err(*item) } else { Ok(()) };
    assert_eq!(each(&items, odd_ones_fail), Err(1));
}
