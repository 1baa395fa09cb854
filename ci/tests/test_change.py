"""Change detection: silent on noise, quick on real changes."""

import random

import pytest

from night.change import COST, METRIC, detect


def noisy(count, level=10.0, spread=0.02, seed=1):
    source = random.Random(seed)
    return [level * (1.0 + source.gauss(0.0, spread)) for _ in range(count)]


def test_first_night_has_no_history():
    assert detect([], 1.0, METRIC).state == "no history"
    assert detect([1.0, 1.0, 1.0], 1.0, COST).state == "no history"


def test_same_commit_twice_is_no_change():
    assert detect([0.4321], 0.4321, METRIC).state == "no change"


def test_rounding_is_no_change_of_a_metric_without_spread():
    assert detect([2.16] * 10, 2.16 * (1.0 + 1e-9), METRIC).state == "no change"
    assert detect([0.0] * 10, 1e-15, METRIC).state == "no change"


@pytest.mark.parametrize("value, state", [(2.17, "up"), (2.15, "down"), (2.1605, "no change")])
def test_metric_moves_at_once(value, state):
    assert detect([2.16] * 5, value, METRIC).state == state


def test_metric_that_is_noisy_by_itself_gets_a_wide_limit():
    past = noisy(20, spread=0.01)
    assert detect(past, 10.2, METRIC).state == "no change"
    assert detect(past, 12.0, METRIC).state == "up"


def test_noise_of_the_machine_is_no_change_of_cost():
    past = noisy(20, spread=0.03)
    flagged = sum(detect(past[:n], past[n], COST).changed for n in range(4, 20))
    assert flagged == 0


def test_one_slow_night_is_only_suspect():
    assert detect([10.0] * 8, 20.0, COST).state == "suspect"


def test_second_slow_night_confirms():
    assert detect([10.0] * 8 + [20.0], 20.0, COST).state == "up"
    assert detect([10.0] * 8 + [5.0], 5.0, COST).state == "down"


def test_slow_night_then_fast_night_confirms_nothing():
    assert detect([10.0] * 8 + [20.0], 5.0, COST).state == "suspect"


def test_outliers_do_not_hide_a_change():
    past = [10.0, 10.1, 9.9, 10.0, 50.0, 10.0, 60.0, 10.1, 9.9, 10.0]
    assert detect(past + [13.0], 13.0, COST).state == "up"


@pytest.mark.parametrize("rule", [METRIC, COST])
def test_slow_drift_is_seen_against_the_window(rule):
    # 2 % more each night: no night stands out against the last, but against the median they do.
    past = [10.0 * 1.02**n for n in range(20)]
    assert any(detect(past[:n], past[n], rule).changed for n in range(6, 20))


def test_change_stays_red_until_it_is_the_normal_of_the_window():
    past = [2.16] * 3
    for night in range(3):
        assert detect(past, 2.4, METRIC).state == "up", night
        past.append(2.4)


def test_lost_and_new_values():
    assert detect([1.0, 1.0], None, METRIC).state == "vanished"
    assert detect([None, None], 1.0, METRIC).state == "appeared"
    assert detect([1.0, None], 1.0, METRIC).state == "no change"
    assert detect([1.0, None], None, METRIC).state == "no history"


def test_nan_is_refused():
    with pytest.raises(ValueError, match="finite"):
        detect([1.0], float("nan"), METRIC)
    with pytest.raises(ValueError, match="history"):
        detect([float("inf")], 1.0, METRIC)
