"""CSV files of others, as they come."""

import pytest

from lay import their_series

PLAIN = "time [s],front_dense [m]\n0,0.1\n0.5,0.2\n1,0.3\n"
ROWS = [["0.0", "0.1"], ["0.5", "0.2"], ["1.0", "0.3"]]


def read(tmp_path, text, names=None):
    path = tmp_path / "theirs.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return their_series.read(path, names)


@pytest.mark.parametrize("text", [
    PLAIN,
    PLAIN.replace("\n", "\r\n"),
    PLAIN.replace("\n", "\r"),
    PLAIN.rstrip("\n"),
    "\ufeff" + PLAIN,
    PLAIN.encode("utf-16"),
    PLAIN.replace(",", ", "),
    PLAIN.replace(",", " ,\t"),
    PLAIN.replace(",", ";"),
    PLAIN.replace(",", "\t"),
    PLAIN.replace(",", "; ").replace("0.", "0,"),
    "# made by hand\n\n" + PLAIN + "\n\n",
    '"time [s]","front_dense [m]"\n"0","0.1"\n"0.5","0.2"\n"1","0.3"\n',
    "time (s),front_dense (m)\n0,0.1\n0.5,0.2\n1,0.3\n",
])
def test_all_forms_are_the_same_series(tmp_path, text):
    understood = read(tmp_path, text)
    assert understood.header == ["time [s]", "front_dense [m]"]
    assert understood.rows == ROWS
    assert understood.said[0].startswith("3 rows of 2 columns")


def test_what_was_understood_is_said(tmp_path):
    said = read(tmp_path, "time [ms];front_dense [mm]\n1000;300\n0;100,0\n500;200\n").said
    assert said == ["3 rows of 2 columns, separated by semicolons, decimal commas", "'time [ms]' is taken as time [s], times 0.001",
                    "'front_dense [mm]' is taken as front_dense [m], times 0.001",
                    "the rows were not in the order of time, and were sorted"]


def test_units_are_converted(tmp_path):
    understood = read(tmp_path, "time [ms],front_dense [cm],p_base [kPa],slope [rad],f_s_max [%]\n500,20,1.5,0.5,60\n1500,30,2,1,61\n")
    assert understood.header == ["time [s]", "front_dense [m]", "p_base [Pa]", "slope [deg]", "f_s_max [-]"]
    assert [float(value) for value in understood.rows[0]] == pytest.approx([0.5, 0.2, 1500.0, 28.64788976, 0.6])


def test_names_are_mapped(tmp_path):
    text = "Time [s],x front [mm]\n0,100\n1,200\n"
    understood = read(tmp_path, text, {"time": "Time", "front_dense": "x front"})
    assert understood.header == ["time [s]", "front_dense [m]"]
    with pytest.raises(their_series.SeriesError, match="there is no column 'y front'; there are: Time"):
        read(tmp_path, text, {"time": "Time", "front_dense": "y front"})


def test_an_empty_field_is_a_value_that_is_not_known(tmp_path):
    assert read(tmp_path, "time [s],front_dense [m]\n0,0.1\n1,\n").rows[1] == ["1.0", ""]


@pytest.mark.parametrize("text, said", [
    ("", "a header and at least one row"),
    ("time [s],front_dense [m]\n", "a header and at least one row"),
    ("time [s],front_dense [m]\n0,0.1\n0.5,0.2\n0.5,0.3\n", "lines 3 and 4 are of the same time 0.5"),
    ("time [s],front_dense [m]\n1,0.1\n0.5,0.2\n1,0.3\n", "lines 2 and 4 are of the same time 1"),
    ("time [s],front_dense [m]\n0,0.1\n1,0.2,0.3\n", "line 3 has 3 fields, the header 2"),
    ("time [s],front_dense [m]\n0,0.1\n1,far\n", "line 3, front_dense: 'far' is not a finite number"),
    ("time [s],front_dense [m]\n0,0.1\n1,nan\n", "not a finite number"),
    ("time [s],front_dense [m]\n0,0.1\n,0.2\n", "line 3 has no time"),
    ("time [s],front_dense\n0,0.1\n", "the column 'front_dense' states no unit"),
    ("time [s],front_dense [ft]\n0,0.1\n", "is in 'ft'; known: s, ms"),
    ("time [s],time [s]\n0,0.1\n", "'time' is given twice"),
    ("front_dense [m],p_base [Pa]\n0,0.1\n", "one column 'time .s.' or 'T .-.' is needed, there are 0"),
    ("time [s],T [-]\n0,0.1\n", "there are 2"),
    ("one column\n1\n", "names one column"),
    (b"\x89HDF\r\n\x1a\n" + bytes(range(200, 250)), "neither UTF-8 nor UTF-16"),
    (b"a\x00b\n1,2\n", "no text"),
])
def test_bad_files_are_one_line(tmp_path, text, said):
    with pytest.raises(their_series.SeriesError, match=said) as refused:
        read(tmp_path, text)
    assert "\n" not in str(refused.value)


def test_a_directory_or_nothing_is_one_line(tmp_path):
    for path in (tmp_path, tmp_path / "none.csv"):
        with pytest.raises(their_series.SeriesError):
            their_series.read(path)


def test_a_map_is_pairs():
    assert their_series.names_of_map("f_s=alpha.a, u_s = U.a") == {"f_s": "alpha.a", "u_s": "U.a"}
    assert their_series.names_of_map("") == {}
    for wrong in ("f_s", "f_s=", "=alpha", "f_s=a,f_s=b"):
        with pytest.raises(their_series.SeriesError):
            their_series.names_of_map(wrong)


def test_what_is_written_is_read_by_the_comparison(tmp_path):
    their_series.write(read(tmp_path, PLAIN.replace(",", ";")), tmp_path / "out.csv")
    assert (tmp_path / "out.csv").read_text() == "time [s],front_dense [m]\n0.0,0.1\n0.5,0.2\n1.0,0.3\n"
