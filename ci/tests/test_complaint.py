"""What is said of a name steers no terminal, and is one short line."""

import complaint


def test_what_steers_a_terminal_is_escaped(capsys):
    complaint.complain("a\x1b[31m\nb\u202ec\udcff é")
    assert capsys.readouterr().err == "a\\u001B[31m\\u000Ab\\u202Ec\\uDCFF é\n"


def test_a_long_one_is_cut():
    assert complaint.printable("x" * 5000) == "x" * 1500 + "... (5000 characters)"
