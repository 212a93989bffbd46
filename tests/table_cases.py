"""Small inputs that a reader may bring, each with the reading that a person would expect.

Written by hand; Python's read_table and the page's readTable must both give them. A case is
(text, columns, what else): columns in the order of the table, a gap is nan; "time" and "value" are
the columns that are taken unless the reader chooses others; "en" must stand in the note.
"""

nan = float("nan")

# --- numbers without trouble --------------------------------------------------------------------

PLAIN = [
    ("1\n2\n3\n", {"1": [1, 2, 3]}, {"value": "1"}),
    ("Suhu\n0,39\n-0,49\n", {"Suhu": [0.39, -0.49]}, {"value": "Suhu"}),
    ("\ufeffz\r\n0.39\r\n0.49\r\n\r\n", {"z": [0.39, 0.49]}, {}),
    ("1,5\n2,6", {"1": [1.5, 2.6]}, {"en": "'1,5' was read as one number"}),
    ("t,v\n1,5\n2,6", {"t": [1, 2], "v": [5, 6]}, {"time": "t", "value": "v"}),
    ('"1,5","2,5"\n"1","3,25"', {"1": [1.5, 1], "2": [2.5, 3.25]}, {}),
    ("1;2,5\n3;4", {"1": [1, 3], "2": [2.5, 4]}, {"time": "1", "value": "2"}),
    ("t\tv\n0,5\t1.234,5\n1\t-2", {"t": [0.5, 1], "v": [1234.5, -2]}, {}),
    ("   9.5    10.1\n  10.5   110.1", {"1": [9.5, 10.5], "2": [10.1, 110.1]}, {}),
    ("0,5 1,2\n0,6 1,3", {"1": [0.5, 0.6], "2": [1.2, 1.3]}, {}),
    ("1\nNA\n-\n\n2", {"1": [1, nan, nan, nan, 2]}, {}),
    ("\u22120,5\n\u20132\n+1e-3", {"1": [-0.5, -2, 0.001]}, {}),
    ("a;a;;a\n1;2;3;4", {"a": [1], "a (2)": [2], "3": [3], "a (3)": [4]}, {}),
]

# --- dates and clock times (A1, B6) -------------------------------------------------------------

TIMES = [
    ("10:00 21,5\n10:05 21,7", {"1": [0, 300], "2": [21.5, 21.7]}, {"time": "1", "value": "2"}),
    ("10:00:00;21,5\n10:00:01;21,7", {"1": [0, 1], "2": [21.5, 21.7]}, {"time": "1"}),
    (
        "2026-01-01 10:00 21,5\n2026-01-01 10:05 21,7",
        {"1": [0, 300], "3": [21.5, 21.7]},
        {"time": "1", "value": "3"},
    ),
    (
        "01/02/2026 21,5\n02/02/2026 21,7",
        {"1": [0, 86400], "2": [21.5, 21.7]},
        {"time": "1", "value": "2", "en": "day before month"},
    ),
    ("01/13/2026;5\n01/14/2026;6", {"1": [0, 86400], "2": [5, 6]}, {"time": "1"}),
    ("A 21,5\nA 21,7", {"2": [21.5, 21.7]}, {"value": "2"}),
    ("Rp 1.500,00\nRp 2.000,00", {"1": [1500, 2000]}, {"units": {"1": "Rp"}}),
    (
        "waktu,v\n2024-01-01T00:00:01,5\n2024-01-01T00:00:03,6",
        {"waktu": [0, 2], "v": [5, 6]},
        {"time": "waktu", "value": "v", "units": {"waktu": "s"}},
    ),
    (
        "waktu;v\n2024-01-01T00:00:01.250Z;5\n2024-01-01T00:00:01.500Z;6",
        {"waktu": [0, 0.25], "v": [5, 6]},
        {},
    ),
    (
        "waktu;v\n2024-01-01T08:00+07:00;5\n2024-01-01T02:00Z;6",
        {"waktu": [0, 3600], "v": [5, 6]},
        {},
    ),
    (
        "Tanggal,jam,Laju\n2024-01-01,23:59,1.5\n2024-01-02,00:01,2.5",
        {"Tanggal jam": [0, 120], "Laju": [1.5, 2.5]},
        {"time": "Tanggal jam", "value": "Laju"},
    ),
    ("jam;v\n23:59:58;1\n23:59:59;2\n00:00:01;3", {"jam": [0, 1, 3], "v": [1, 2, 3]}, {}),
    ("t;v\n10:00:05 PM;1\n10:00:06 PM;2", {"t": [0, 1], "v": [1, 2]}, {}),
    ("1 Mei 2024;5\n2 Mei 2024;7", {"1": [0, 86400], "2": [5, 7]}, {"time": "1"}),
    ("31-Dec-2023;5\n01-Jan-2024;7", {"1": [0, 86400], "2": [5, 7]}, {"time": "1"}),
    (
        "Tanggal;Jam;Suhu\n01/02/2026;10.30;21,5\n01/02/2026;10.35;21,7",
        {"Tanggal Jam": [0, 300], "Suhu": [21.5, 21.7]},
        {},
    ),
    ("10:00, 21,5\n10:05, 21,7", {"1": [0, 300], "2": [21.5, 21.7]}, {}),
    ("pukul;suhu\n10.30;21,5\n10.35;21,7", {"pukul": [0, 300], "suhu": [21.5, 21.7]}, {}),
    ("waktu;v\n10:00;1\n;2\n10:02;3", {"waktu": [0, nan, 120], "v": [1, 2, 3]}, {}),
    ("2024-01-01 10:00,21.5\n2024-01-01 10:01,21.7", {"1": [0, 60], "2": [21.5, 21.7]}, {}),
    ("lap;v\n75:30;1\n75:31;2", {"lap": [0, 1], "v": [1, 2]}, {"time": "lap"}),
    (
        "timestamp,v\n1700000000000,5\n1700000000100,6",
        {"timestamp": [1700000000000, 1700000000100], "v": [5, 6]},
        {"time": "timestamp", "units": {"timestamp": "ms"}},
    ),
]

# --- which column is what (A2) ------------------------------------------------------------------

ROLES = [
    ("t;suhu\n0;21,5\n1;21,7", {"t": [0, 1], "suhu": [21.5, 21.7]}, {"time": "t", "value": "suhu"}),
    (
        "No;t (s);v (m/s)\n1;0,0;0,5\n2;0,1;0,6",
        {"No": [1, 2], "t (s)": [0, 0.1], "v (m/s)": [0.5, 0.6]},
        {"time": "t (s)", "value": "v (m/s)", "units": {"t (s)": "s", "v (m/s)": "m/s"}},
    ),
    (
        "time,moment,speed\n0,7,1.5\n1,8,1.6",
        {"time": [0, 1], "moment": [7, 8], "speed": [1.5, 1.6]},
        {"time": "time", "value": "speed"},
    ),
    (
        "timestamp,lat,lon,speed\n0,-6.5,106.8,1.5\n1,-6.6,106.9,1.6",
        {"timestamp": [0, 1], "lat": [-6.5, -6.6], "lon": [106.8, 106.9], "speed": [1.5, 1.6]},
        {"time": "timestamp", "value": "speed"},
    ),
    (
        "t (ms);v (km/h)\n0;10\n100;11",
        {"t (ms)": [0, 100], "v (km/h)": [10, 11]},
        {"time": "t (ms)", "value": "v (km/h)", "units": {"t (ms)": "ms", "v (km/h)": "km/h"}},
    ),
    ("v;t\n1.5;0\n1.6;1", {"v": [1.5, 1.6], "t": [0, 1]}, {"time": "t", "value": "v"}),
    ("No;suhu\n1;21,5\n2;21,7", {"No": [1, 2], "suhu": [21.5, 21.7]}, {"time": None}),
    (";suhu\n0;21,5\n1;21,7", {"1": [0, 1], "suhu": [21.5, 21.7]}, {"time": None}),
    ("T;RH\n21;60\n20;61", {"T": [21, 20], "RH": [60, 61]}, {"time": None, "value": "T"}),
    (
        "waktu (detik);kecepatan (km/jam)\n0;36\n1;72",
        {"waktu (detik)": [0, 1], "kecepatan (km/jam)": [36, 72]},
        {"units": {"waktu (detik)": "s", "kecepatan (km/jam)": "km/h"}},
    ),
    (
        "time_us,speed_kmh\n0,36\n1000,72",
        {"time_us": [0, 1000], "speed_kmh": [36, 72]},
        {"units": {"time_us": "us", "speed_kmh": "km/h"}, "time": "time_us"},
    ),
    (
        "seconds_elapsed,v\n0,1\n0.5,2",
        {"seconds_elapsed": [0, 0.5], "v": [1, 2]},
        {"time": "seconds_elapsed", "units": {"seconds_elapsed": "s"}},
    ),
    (
        "waktu (ns);v\n0;1\n500000000;2",
        {"waktu (ns)": [0, 5e8], "v": [1, 2]},
        {"time": "waktu (ns)"},
    ),
    ("t\n21\n22\n20", {"t": [21, 22, 20]}, {"time": None, "value": "t"}),
    (
        "1;0,0;21,5\n2;0,1;21,7\n3;0,2;21,6",
        {"1": [1, 2, 3], "2": [0, 0.1, 0.2], "3": [21.5, 21.7, 21.6]},
        {"time": "2", "value": "3"},
    ),
]

# --- codes for missing (A4) ---------------------------------------------------------------------

CODES = [
    ("v\n21\n-999", {"v": [21, nan]}, {"en": "-999 (1x)"}),
    ("v\n-999\n-999", {"v": [-999, -999]}, {"en": "-999 (2x) may stand for missing"}),
    ("v\n21\n-999\n22\n21", {"v": [21, nan, 22, 21]}, {"en": "-999 (1x)"}),
    ("suhu\n21,5\n-127\n21,6\n85\n21,5", {"suhu": [21.5, nan, 21.6, nan, 21.5]}, {"en": "85 (1x)"}),
    (
        "hujan;n\n0,5;1\n8888;2\n1,5;3",
        {"hujan": [0.5, nan, 1.5], "n": [1, 2, 3]},
        {"en": "8888 (1x)"},
    ),
    ("p\n998\n999\n1001\n1000", {"p": [998, 999, 1001, 1000]}, {}),
    ("v\n21\n-5\n22\n-5", {"v": [21, nan, 22, nan]}, {"missing": [-5], "en": "-5 (2x)"}),
    ("v\n21\n-999\n22\n21", {"v": [21, -999, 22, 21]}, {"missing": []}),
    ("v\n21\n-999\n22\n21", {"v": [21, nan, 22, 21]}, {"missing": -999}),
]

# --- thousands (A5), spaces in numbers (B4) -----------------------------------------------------

THOUSANDS = [
    ("Rp1.500\nRp2.000\nRp12.500", {"1": [1500, 2000, 12500]}, {"units": {"1": "Rp"}}),
    ("1\u00a0234,5\n2\u00a0345,5", {"1": [1234.5, 2345.5]}, {}),
    ("t;v\n0;1\u202f234,5\n1;2\u202f345,5", {"t": [0, 1], "v": [1234.5, 2345.5]}, {}),
    ("t;v\n0;1 234,5\n1;2 345,5", {"t": [0, 1], "v": [1234.5, 2345.5]}, {}),
    ("1 000\n2 000", {"1": [1000, 2000]}, {}),
    ("v\n1'234.5\n2'345.5", {"v": [1234.5, 2345.5]}, {}),
    ("t;v\n0,5;1.000\n1;2.000", {"t": [0.5, 1], "v": [1000, 2000]}, {}),
    ("t;v\n0.5;1,000\n1;2,000", {"t": [0.5, 1], "v": [1000, 2000]}, {}),
    (
        "1.234\n2.345",
        {"1": [1.234, 2.345]},
        {"en": "'1.234' was read as a decimal, not as thousands"},
    ),
    ("25,1, 25,3\n25,0, 24,9", {"1": [25.1, 25.0], "2": [25.3, 24.9]}, {}),
    ("harga\n100.000\n120.000", {"harga": [1e5, 1.2e5]}, {"decimal": ","}),
    ("harga\n100.000\n120.000", {"harga": [100, 120]}, {"decimal": "."}),
]

# --- text around a table (B2) -------------------------------------------------------------------

AROUND = [
    (
        '"Plot Title: 1"\n"#","Date Time, GMT+07:00","Temp, °C (LGR S/N: 101)","Host"\n'
        '1,"01/13/24 10:00:00 AM",21.5,\n2,"01/13/24 10:05:00 AM",21.6,Logged',
        {"1": [1, 2], "Date Time, GMT+07:00": [0, 300], "Temp, °C (LGR S/N: 101)": [21.5, 21.6]},
        {"value": "Temp, °C (LGR S/N: 101)", "units": {"Temp, °C (LGR S/N: 101)": "°C"}},
    ),
    (
        "TOA5,CR1000,1234\nTIMESTAMP,RECORD,AirTC_Avg\nTS,RN,Deg C\n,,Avg\n"
        "2024-01-01 00:00:00,0,21.5\n2024-01-01 00:10:00,1,21.7",
        {"TIMESTAMP": [0, 600], "RECORD": [0, 1], "AirTC_Avg": [21.5, 21.7]},
        {"time": "TIMESTAMP", "value": "AirTC_Avg", "units": {"AirTC_Avg": "DegC"}},
    ),
    (
        "Data suhu ruang\nLab Instrumentasi\n\nt;suhu\n0;21,5\n1;21,7\n",
        {"t": [0, 1], "suhu": [21.5, 21.7]},
        {"time": "t", "en": "lines 1-2 were passed over"},
    ),
    (
        "t;v\ns;m/s\n0;1,5\n1;1,6",
        {"t": [0, 1], "v": [1.5, 1.6]},
        {"units": {"t": "s", "v": "m/s"}},
    ),
    (
        "Waktu;Kecepatan\n(s);(m/s)\n0;1,5\n1;1,6",
        {"Waktu": [0, 1], "Kecepatan": [1.5, 1.6]},
        {"units": {"Waktu": "s", "Kecepatan": "m/s"}},
    ),
    (
        "t;v\n0;1,5\n1;1,6\n\nCatatan: sensor basah\n",
        {"t": [0, 1], "v": [1.5, 1.6]},
        {"en": "line 5 was passed over"},
    ),
    ("sep=;\nt;v\n0;1,5\n1;1,6", {"t": [0, 1], "v": [1.5, 1.6]}, {}),
    ("# comment, with a comma\nt,v\n0,1.5\n1,1.6", {"t": [0, 1], "v": [1.5, 1.6]}, {}),
    ('"Plot Title: A"\n"t","v"\n0,1.5\n1,1.6', {"t": [0, 1], "v": [1.5, 1.6]}, {}),
    (
        "ID WMO;: 96733\nNama;: Kemayoran\nLintang;: -6.15\nBujur;: 106.84\nElevasi;: 4\n\n"
        "Tanggal;TN;TX\n01-01-2024;24,1;32,5\n02-01-2024;8888;31,0\n03-01-2024;23,9;30,2\n\n"
        "8888: data tidak terukur\n9999: tidak ada data\n",
        {"Tanggal": [0, 86400, 172800], "TN": [24.1, nan, 23.9], "TX": [32.5, 31, 30.2]},
        {"time": "Tanggal", "value": "TN", "en": "8888 (1x)"},
    ),
    ("t,v,Logger 12345\n0,1.5\n1,1.6", {"t": [0, 1], "v": [1.5, 1.6]}, {}),
    ("Serial;12345\nt;v\n0;1,5\n1;1,6", {"t": [0, 1], "v": [1.5, 1.6]}, {}),
    ("t;v\n0;1,5\n1;1,6\nRata-rata;1,55", {"t": [0, 1], "v": [1.5, 1.6]}, {"en": "line 4"}),
    ("t;v;catatan\n0;1,5;ok\n1;1,6;ok", {"t": [0, 1], "v": [1.5, 1.6]}, {"en": "catatan"}),
    ("t;v\n0;21,5 °C\n1;21,7 °C", {"t": [0, 1], "v": [21.5, 21.7]}, {"units": {"v": "°C"}}),
]

# --- a row or a list is data (B5) ---------------------------------------------------------------

LISTS = [
    ("data: [1.5, 2.5, 3]", {"1": [1.5, 2.5, 3]}, {}),
    ("z=[1.5 2.5 ...\n 3.5];", {"z": [1.5, 2.5, 3.5]}, {}),
    ("[1.0, 2.0, 3.0]", {"1": [1, 2, 3]}, {}),
    ("1, 2, 3", {"1": [1, 2, 3]}, {}),
    ("1;2;3", {"1": [1, 2, 3]}, {}),
    ("1,5 2,6 3,7", {"1": [1.5, 2.6, 3.7]}, {}),
    ("[1 2 3]", {"1": [1, 2, 3]}, {}),
    ("[1; 2; 3]", {"1": [1, 2, 3]}, {}),
    ("x = [1.5, 2.5, 3.5];", {"x": [1.5, 2.5, 3.5]}, {"value": "x"}),
    ("z = np.array([1.0,\n 2.0,\n 3.5])", {"z": [1, 2, 3.5]}, {}),
    ("[[0, 21.5], [1, 21.7]]", {"1": [0, 1], "2": [21.5, 21.7]}, {"time": "1", "value": "2"}),
    ("[0 21.5; 1 21.7]", {"1": [0, 1], "2": [21.5, 21.7]}, {}),
    ("[1.0, None, nan, 4]", {"1": [1, nan, nan, 4]}, {}),
    (
        "t = [0, 1, 2]\nv = [21.5, 21.7, 21.6]",
        {"t": [0, 1, 2], "v": [21.5, 21.7, 21.6]},
        {"time": "t"},
    ),
    ("suhu;21,5;21,7;21,9", {"suhu": [21.5, 21.7, 21.9]}, {}),
    ("t;0;1;2\nv;21,5;21,7;21,6", {"t": [0, 1, 2], "v": [21.5, 21.7, 21.6]}, {"time": "t"}),
]

READ = PLAIN + TIMES + ROLES + CODES + THOUSANDS + AROUND + LISTS

# --- refused: (text, what else, a part of the sentence in English, in Indonesian) ---------------

REFUSED = [
    ("2026-01-01,21,5\n2026-01-02,21,7", {}, "comma may separate", "koma dapat memisahkan"),
    ("", {}, "no column of numbers", "Tidak ada kolom bilangan"),
    ("a\nb", {}, "no column of numbers", "Tidak ada kolom bilangan"),
    ("1\nx\n3", {}, "Line 2, column '1': 'x'", "Baris 2, kolom '1': 'x'"),
    ("1\nx", {}, "Line 2, column '1': 'x'", "Baris 2, kolom '1': 'x'"),
    ("1\n2 3 4", {}, "'2 3 4' is neither", "'2 3 4' bukan"),
    ("1\n=cmd|' /C calc'!A0", {}, "Line 2", "Baris 2"),
    ("12.34.5\n1", {}, "Line 1, column '1': '12.34.5'", "Baris 1, kolom '1'"),
    ("1\n#DIV/0!\n3", {}, "'#DIV/0!' is neither", "'#DIV/0!' bukan"),
    ("a;b\n0,5;12.34\n", {}, "'12.34' in line 2, '0,5' in line 2", "'12.34' di baris 2"),
    ("1,234.5\n2,345.6", {}, "comma may separate", "koma dapat memisahkan"),
    ("harga\n100.000\n120.000", {}, "may be a thousand", "dapat berarti ribuan"),
    ("1;2\n3;4;5", {}, "Line 2 has not as many cells (3)", "Banyaknya sel di baris 2 (3)"),
    (
        "1;2\n3;4;5\n6;7\n8;9",
        {},
        "Line 2 has not as many cells (3)",
        "Banyaknya sel di baris 2 (3)",
    ),
    ('"a\n1', {}, "quotation marks", "Tanda kutip"),
    ("1\ninf", {}, "'inf' is too large", "'inf' terlalu besar"),
    ("1\n1e301", {}, "'1e301' is too large", "'1e301' terlalu besar"),
    ("tanggal\n2024-01-01\n2024-01-02", {}, "no column of numbers", "Tidak ada kolom bilangan"),
    ("t;v\n0;1\n1;satu\n2;3", {}, "Line 3, column 'v': 'satu'", "Baris 3, kolom 'v': 'satu'"),
]

# --- hostile and huge: made, not written down; each must be refused or read within seconds ------

HUGE = {
    "rows": lambda: "1\n" * 1_000_000,
    "bytes": lambda: "1.23456789;" * 3 + "1\n" + "1.23456789;1;2;3\n" * 1_000_000,
    "columns": lambda: ";".join(["x"] * 100_000) + "\n" + ";".join(["1"] * 100_000),
    "equal names": lambda: ";".join(["x"] * 900) + "\n" + ";".join(["1"] * 900),
    "blanks in a header": lambda: "a" + " " * 200_000 + "b\n1\n2",
    "underscores in a header": lambda: "_" * 600_000 + "\n1\n2",
    "blanks at ends of lines": lambda: "1" + " " * 500_000 + "x\n2\n",
    "digits": lambda: "1\n" + "9" * 120_000 + "x\n3",
    "brackets": lambda: "[" * 300_000 + "1\n",
    "commas": lambda: "," * 2_000_000,
    "blank lines": lambda: "1" + "\n" * 1_000_000 + "2",
    "quotation marks": lambda: '"' * 400_001,
    "colons": lambda: "1:" * 300_000,
    "long list": lambda: "[" + "1, " * 2_000_000 + "1]",
}


def options_of(more):
    """What of the third part of a case is an argument of read_table."""
    return {key: more[key] for key in ("decimal", "missing") if key in more}
