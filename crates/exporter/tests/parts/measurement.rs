//! Tables in all dialects, and what is said of those that are none.

use brinell_exporter::measurement::{Choices, Measurement, read};

fn of(text: &[u8]) -> Result<Measurement, String> {
    read(text, &Choices::default()).map_err(|wrong| wrong.to_string())
}

/// The numbers of a column in SI units.
fn numbers(table: &Measurement, key: &str) -> Vec<f64> {
    let columns = table.of(key);
    assert_eq!(columns.len(), 1, "{key}");
    table.numbers(columns[0]).unwrap_or_else(|wrong| panic!("{wrong}"))
}

/// How a table is written.
#[derive(Debug)]
struct Dialect {
    separator: &'static str,
    decimal: char,
    /// Quotation marks around nothing, around texts, around all.
    quotes: u8,
    heading: &'static str,
    line_end: &'static str,
    mark: &'static [u8],
}

impl Dialect {
    fn all() -> impl Iterator<Item = Dialect> {
        let mut all = Vec::new();
        for separator in [";", "\t", ",", "|", "   ", " ", ", ", " ; "] {
            for decimal in ['.', ','] {
                for quotes in [0, 1, 2] {
                    for heading in ["plain", "brackets", "hash", "units below", "preamble", "comments", "said"] {
                        for line_end in ["\n", "\r\n", "\r"] {
                            for mark in [&b""[..], b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"] {
                                all.push(Dialect { separator, decimal, quotes, heading, line_end, mark });
                            }
                        }
                    }
                }
            }
        }
        let is_one = |dialect: &Dialect| {
            // numbers would have the separator in them
            let clashes = dialect.separator.contains(',') && dialect.decimal == ',' && dialect.quotes < 2;
            let cant_be_said = dialect.heading == "said" && dialect.separator.len() > 1;
            !clashes && !cant_be_said
        };
        all.into_iter().filter(is_one)
    }

    fn quoted(&self, cell: &str, is_text: bool) -> String {
        let is_quoted = self.quotes == 2 || (self.quotes == 1 && is_text);
        if is_quoted { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.into() }
    }

    fn line(&self, cells: &[&str], is_text: bool) -> String {
        cells.iter().map(|cell| self.quoted(cell, is_text)).collect::<Vec<_>>().join(self.separator)
    }

    fn write(&self, rows: &[[f64; 2]]) -> Vec<u8> {
        let bare = ["speed", "restitution", "remark"];
        let with_units = ["Impact speed [m/s]", "e (-)", "remark"];
        // one blank is in no name where it separates
        let names = if self.separator == " " && self.quotes == 0 { bare } else { with_units };
        let mut lines = match self.heading {
            "plain" => vec![self.line(&bare, true)],
            "brackets" => vec![self.line(&names, true)],
            "hash" => vec![format!("# {}", self.line(&bare, true))],
            "units below" => vec![self.line(&bare, true), self.line(&["m/s", "-", ""], true)],
            "preamble" => {
                vec!["Machine X".into(), String::new(), "Operator: J. van der Berg".into(), self.line(&names, true)]
            }
            "comments" => vec!["# written by a machine".into(), "#".into(), format!("#{}", self.line(&names, true))],
            _ => vec![format!("sep={}", self.separator), self.line(&names, true)],
        };
        // a line without a last cell has two in blanks
        let is_blank = self.separator.trim().is_empty() && self.separator != "\t" && self.quotes == 0;
        if self.heading == "units below" && is_blank {
            lines[1] = self.line(&["m/s", "-", "-"], true);
        }
        for (index, [speed, restitution]) in rows.iter().enumerate() {
            let [speed, restitution] = [speed, restitution].map(|number| {
                let text = if index % 5 == 4 { format!("{number:e}") } else { format!("{number}") };
                self.quoted(&text.replace('.', &self.decimal.to_string()), false)
            });
            let words = if self.quotes == 2 { "off \"centre\", by 1; or 2" } else { "off centre" };
            let words = if self.separator == " " && self.quotes == 0 { "clean" } else { words };
            let words = if index % 2 == 0 { "clean" } else { words };
            lines.push([speed, restitution, self.quoted(words, true)].join(self.separator));
        }
        let text = lines.join(self.line_end) + self.line_end;
        let wide = |of: fn(u16) -> [u8; 2]| self.mark.iter().copied().chain(text.encode_utf16().flat_map(of)).collect();
        match self.mark {
            b"\xff\xfe" => wide(u16::to_le_bytes),
            b"\xfe\xff" => wide(u16::to_be_bytes),
            mark => [mark, text.as_bytes()].concat(),
        }
    }
}

/// Separator, decimal sign, quotes, heading, line ends and mark in all combinations.
#[test]
fn a_table_in_any_dialect_reads_back_the_same_bits() {
    let mut random = fastrand::Rng::with_seed(61);
    let mut count = 0;
    for dialect in Dialect::all() {
        let mut row = || [0.1 + 9.0 * random.f64(), 0.05 + 0.9 * random.f64()];
        let rows: Vec<[f64; 2]> = (0..1 + count % 7).map(|_| row()).collect();
        let bytes = dialect.write(&rows);
        let shown = || String::from_utf8_lossy(&bytes).into_owned();
        let table = of(&bytes).unwrap_or_else(|why| panic!("{dialect:?}: {why}\n{}", shown()));
        let found = [numbers(&table, "speed"), numbers(&table, "restitution")];
        let expected = [0, 1].map(|column| rows.iter().map(|row| row[column]).collect::<Vec<_>>());
        assert_eq!(found, expected, "{dialect:?}\n{}", shown());
        assert_eq!(table.unknown, ["remark"], "{dialect:?}\n{}", shown());
        count += 1;
    }
    assert!(count > 1500, "{count}");
}

/// Files of laboratories, and numbers of theirs in SI units.
#[test]
fn tables_of_laboratories_are_read() {
    for (text, key, expected) in [
        (
            "speed [m/s],restitution,remark\n1.5,0.6,clean hit at centre\n2,0.5,slightly off centre line\n",
            "restitution",
            &[0.6, 0.5][..],
        ),
        (
            "date,speed [m/s],restitution\n2024-03-01 10:12:00,1.5,0.6\n2024-03-01 10:15:00,2,0.5\n",
            "speed",
            &[1.5, 2.0],
        ),
        ("date;speed [m/s];restitution\n01.03.2024;1,5;0,6\n02.03.2024;2;0,5\n", "speed", &[1.5, 2.0]),
        ("specimen;speed [m/s];restitution\nplate A no 1;1.5;0.6\nplate A no 2;2;0.5\n", "speed", &[1.5, 2.0]),
        ("# speed restitution\n1.500e+00 6.000e-01\n2.000e+00 5.000e-01\n", "restitution", &[0.6, 0.5]),
        // numpy.savetxt(header="...") separates the names otherwise than the numbers
        ("# speed [m/s], restitution\n1.500e+00 6.000e-01\n2.000e+00 5.000e-01\n", "speed", &[1.5, 2.0]),
        ("# Impact speed (m/s)  Rebound speed (m/s)\n1.5 0.5\n2 0.6\n", "rebound_speed", &[0.5, 0.6]),
        (
            "Impact speed (m/s),Rebound speed (m/s),Operator name\n1.5,0.5,J. van der Berg\n2,0.6,J. van der Berg\n",
            "rebound_speed",
            &[0.5, 0.6],
        ),
        ("Drop height (m),Return height (m)\n0.1,0.059\n0.2,0.145\n", "rebound_height", &[0.059, 0.145]),
        ("Displacement Into Surface\tLoad On Sample\nnm\tmN\n12.5\t0.25\n25\t0.5\n", "force", &[0.25e-3, 0.5e-3]),
        ("Displacement Into Surface (nm)\tLoad On Sample (mN)\tTime (s)\n12.5\t0.25\t1\n", "depth", &[12.5e-9]),
        ("time [s],bounce interval [s]\n0.0,0.2501\n0.2501,0.2484\n", "bounce_interval", &[0.2501, 0.2484]),
        ("\"Kraft\n[kN]\";\"Weg\n[\u{b5}m]\"\n1.250,5;2,5\n1.251,5;3\n", "force", &[1_250_500.0, 1_251_500.0]),
        ("depth [um];force\n1;1'234.5\n2;2'345.6\n", "force", &[1234.5, 2345.6]),
        ("depth [um],force [daN],\n1,2.5,\n2,3.5,\n", "force", &[25.0, 35.0]),
        (",depth [um],force [N]\n0,1,2.5\n1,2,3.5\n", "force", &[2.5, 3.5]),
        ("Tensile strain (Strain 1) (%)\tTensile stress (MPa)\tStrain rate (1/s)\n0.1\t20\t1\n", "strain", &[0.001]),
        ("force [N]\n12,5\n13,5\n", "force", &[12.5, 13.5]),
    ] {
        let table = of(text.as_bytes()).unwrap_or_else(|why| panic!("{text}: {why}"));
        let found = numbers(&table, key);
        let is_near = |(one, other): (&f64, &f64)| (one / other - 1.0).abs() < 1e-14;
        assert!(found.len() == expected.len() && found.iter().zip(expected).all(is_near), "{text}: {found:?}");
    }
}

#[test]
fn a_table_that_cant_be_read_is_told_with_the_place_and_the_nearest_name() {
    for (text, why) in [
        ("", "the file is empty; expected a heading such as"),
        ("1.052   0.623\n2.013   0.551\n", "the file has no heading; expected a heading such as"),
        ("1.052;0,623\n", "the file has no heading"),
        (
            "Drop hight (m),Comeback height (m)\n0.1,0.059\n",
            "no quantity is called `Drop hight (m)` (drop height?) or `Comeback height (m)` (",
        ),
        (
            "Sample ID,Point 1,Point 2,Average,Test Method\nA-12,212,215,213,ASTM E10 HBW 10/3000\nA-13,221,219,220,ASTM E10 HBW 10/3000\n",
            "line 1, column 1: no quantity is called `Sample ID` or `Point 1` or `Point 2` or `Average` or `Test Method`; a column of readings is called `HBW 10/3000`; expected",
        ),
        ("Displacement Into Surfce (nm)\tx\n12.5\t1\n", "`Displacement Into Surfce (nm)` (displacement?)"),
        ("speed;restitution\n1;0.5\n2;0,6\n", "`0.5` has a decimal point, and `0,6` a decimal comma"),
        ("depth [um];force\n1;1.082\n2;2.164\n", "`1.082` is ambiguous: 1.082 with a decimal sign, or 1082"),
        (
            "speed,restitution\n1,0,0,5\n2,0,0,4\n",
            "line 2: 4 cells, and the heading has 2, separated by commas; a decimal comma",
        ),
        ("speed,restitution\n\"1,0.5\n", "line 2: a quotation mark is not closed"),
        ("speed [furlong/s],e\n1,0.5\n", "line 1, column 1: `furlong/s` is no unit of speed; expected one of `mm/s`"),
        ("depth [um],force [kg]\n1,1\n", "line 1, column 2: `kg` is ambiguous for force: a force in kg is one in kgf"),
        ("depth [um],force [mn]\n1,1\n", "line 1, column 2: `mn` is ambiguous for force: it may be `mN` or `MN`"),
        ("PK\u{3}\u{4}xlsx", "it is a workbook: save it as CSV, or let Python read it"),
    ] {
        let said = of(text.as_bytes()).map(|table| table.notes).expect_err(text);
        assert!(said.contains(why), "{text}: {said}");
    }
}

#[test]
fn readings_have_their_scale_and_several_of_a_row_their_mean_and_spread() {
    for (text, expected) in [
        ("HV10\n200\n210\n", &["200 HV10", "210 HV10"][..]),
        ("hardness [HBW 10/3000];place\n201,5;1\n", &["201.5 HBW 10/3000"]),
        ("hardness\n58 HRC\n640 HV10\n", &["58 HRC", "640 HV10"]),
        ("specimen,BHN\nA,187\n", &["187 BHN"]),
        ("HL\n700\n", &["700 HLD"]),
        ("piece,HRC 1,HRC 2,HRC 3\nA,58,60,62\nB,60,60,60\nC,59,,\n", &["60 \u{b1} 2 HRC", "60 HRC", "59 HRC"]),
        ("HV10 (1);HV10 (2)\n200;210\n", &["205 \u{b1} 7.07 HV10"]),
        ("HBW 10/3000,HBW 10/3000\n212,215\n", &["213.5 \u{b1} 2.12 HBW 10/3000"]),
        ("HBW\n180-220\n", &["180-220 HBW"]),
        ("hardness\n180\u{2013}220 HBW\n", &["180\u{2013}220 HBW"]),
    ] {
        let table = of(text.as_bytes()).unwrap_or_else(|why| panic!("{text}: {why}"));
        assert_eq!(table.readings().unwrap_or_else(|wrong| panic!("{text}: {wrong}")), expected, "{text}");
    }
    for (text, why) in [
        ("HV10\nhard\n", "line 2, column 1: HV10 = `hard` is no reading"),
        ("hardness\n200\n", "line 2, column 1: hardness = `200` has no scale; expected a heading such as `HV10`"),
        ("HV10,HRC\n200,58\n", "line 1, column 2: `HV10` and `HRC` are of two scales"),
        (
            "HBW\n220-180\n",
            "line 2, column 1: HBW = `220-180` is no reading: a range goes from the least number to the largest",
        ),
    ] {
        let said =
            of(text.as_bytes()).unwrap_or_else(|why| panic!("{text}: {why}")).readings().unwrap_err().to_string();
        assert!(said.contains(why), "{text}: {said}");
    }
}
