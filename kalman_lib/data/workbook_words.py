"""What is written in the workbook, in both languages of the book."""

CREATOR = "Filter Kalman, Makalah demi Makalah / The Kalman Filter, Paper by Paper"
FILTER_TITLE = "Filter Kalman skalar / Scalar Kalman filter"
FILTER_HINT = (
    "Ubah sel kuning; semua rumus menghitung ulang. / "
    "Change the yellow cells; every formula follows."
)
RTS_TITLE = "Penghalus RTS / RTS smoother"
RTS_LINES = (
    "Berjalan mundur: setiap nilai juga mengenal pengukuran sesudahnya. / "
    "Runs backwards: every value knows the later measurements too.",
    "G = P / P_pred'     x_smooth = x + G (x_smooth' - x)     P_smooth = G (Q + G P_smooth')",
    "Tanda ' = baris berikutnya. / The sign ' = the next row.",
)
CHART_TITLE = "Filter Kalman / Kalman filter"
MEASURED, FILTERED = "Terukur / Measured", "Terfilter / Filtered"
SMOOTHED = "Terhaluskan / Smoothed"

INPUTS = (  # name, Indonesian, English
    ("Q", "varians proses", "process var."),
    ("R", "varians ukur", "measurement var."),
    ("x0", "tebakan awal", "initial guess"),
    ("P0", "varians x0", "variance of x0"),
)
COUNT_LABEL = "N\njumlah data /\nhow many"
NAME_LABEL = "Data\nnama kolom /\ncolumn name"
FILTER_HEADS = (
    "No",
    "Terukur /\nMeasured\nz",
    "Prediksi /\nPrediction\nx_pred",
    "Varians prediksi /\nIts variance\nP_pred",
    "Inovasi /\nInnovation\ny",
    "Penguatan /\nGain\nK",
    "Terfilter /\nFiltered\nx",
    "Varians /\nVariance\nP",
)
RTS_HEADS = (
    "No",
    "Terfilter /\nFiltered\nx",
    "Varians /\nVariance\nP",
    "P_pred berikutnya /\nnext P_pred",
    "Penguatan /\nGain\nG",
    "Terhaluskan /\nSmoothed\nx_smooth",
    "Varians /\nVariance\nP_smooth",
)
NOTES_TITLE = "Catatan - Notes"
NOTES_HEADS = ("Catatan", "Notes")
NOTES = (  # Indonesian, English
    ("Apa ini?", "What is this?"),
    (
        "Filter Kalman skalar untuk satu kolom pengukuran, dihitung oleh rumus biasa tanpa makro: "
        "lembar Filter maju (waktu nyata), lembar RTS mundur (setelah semua data ada). Kuning: "
        "masukan yang boleh diubah; hijau: hasil.",
        "A scalar Kalman filter for one column of measurements, in plain formulas without macros: "
        "sheet Filter forwards (real time), sheet RTS backwards (once all data is there). Yellow: "
        "input, change it freely; green: result.",
    ),
    ("Persamaan", "Equations"),
    (
        "Model: x berubah acak dengan varians Q di setiap langkah; z mengukur x dengan varians "
        "derau R. Yang menentukan adalah Q/R: yang kecil lebih halus, tetapi lebih terlambat.",
        "Model: x changes at random with variance Q in every step; z measures x with noise "
        "variance R. What matters is Q/R: a small one is smoother, but lags more.",
    ),
    (
        "Prediksi: x_pred = x sebelumnya; P_pred = P sebelumnya + Q (baris pertama memakai x0 dan "
        "P0).",
        "Prediction: x_pred = previous x; P_pred = previous P + Q (the first row uses x0 and P0).",
    ),
    (
        "Pembaruan: y = z - x_pred; K = P_pred / (P_pred + R); x = x_pred + K y; P = K R, sama "
        "dengan (1 - K) P_pred pada makalah. Sel Terukur yang kosong: K = 0.",
        "Update: y = z - x_pred; K = P_pred / (P_pred + R); x = x_pred + K y; P = K R, which "
        "equals the paper's (1 - K) P_pred. An empty Measured cell: K = 0.",
    ),
    (
        "Penghalusan: G = P / P_pred berikutnya; x_smooth = x + G (x_smooth berikutnya - x); "
        "P_smooth = G (Q + G P_smooth berikutnya). Baris terakhir: x dan P.",
        "Smoothing: G = P / next P_pred; x_smooth = x + G (next x_smooth - x); P_smooth = G (Q + "
        "G next P_smooth). Last row: x and P.",
    ),
    ("Memakai data sendiri", "Using your own data"),
    (
        "Tempelkan data sebagai bilangan ke kolom Terukur (B) lembar Filter, mulai baris {first}. "
        "Data lebih panjang: salin baris terakhir ke bawah sampai data habis, di kedua lembar, "
        "dan tarik jangkauan grafik (baris {first} sampai {chart_end}). Data lebih pendek: "
        "kosongkan sel Terukur yang berlebih.",
        "Paste your data as numbers into the Measured column (B) of sheet Filter, from row "
        "{first} on. Longer data: copy the last row down to where the data ends, on both sheets, "
        "and drag the range of the charts (rows {first} to {chart_end}). Shorter data: clear the "
        "Measured cells left over.",
    ),
    (
        "Sel bernama: Q_, R_, x0_, P0_ (Excel tidak mengizinkan nama R).",
        "Named cells: Q_, R_, x0_, P0_ (Excel does not allow the name R).",
    ),
    ("Sumber", "Source"),
    (
        "Formulir ini mengikuti lembar kerja Rudiyanto, Setiawan dan Saptomo (2006), yang memakai "
        "makro Excel.",
        "The form follows the worksheet of Rudiyanto, Setiawan and Saptomo (2006), which used an "
        "Excel macro.",
    ),
)
