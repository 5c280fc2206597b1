from exu_press.plots.busiest import mirror, sides_alike


def test_the_other_side():
    assert mirror("ball_left_force") == "ball_right_force"
    assert mirror("ball_right_loss") == "ball_left_loss"
    assert mirror("crank_pin_force") == "crank_pin_force"


def test_sides_are_alike_until_one_of_them_differs(results):
    result = results["dry"]
    assert sides_alike([result], "ball_left_force")
    assert sides_alike([result], "pivot_left_force")
    uneven = result.with_values({"ball_left_force": 1.01 * result["ball_left_force"]})
    assert not sides_alike([result, uneven], "ball_left_force")
