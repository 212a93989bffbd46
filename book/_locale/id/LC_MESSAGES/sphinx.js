Documentation.addTranslations({
  "locale": "id",
  "messages": {
    ", in ": ", dalam ",
    "Hide Search Matches": "Sembunyikan kata yang ditandai",
    "Preparing search...": "Menyiapkan pencarian …",
    "Search": "Cari",
    "Search Results": "Hasil pencarian",
    "Search finished, found ${resultCount} page(s) matching the search query.": "Pencarian selesai: ${resultCount} halaman ditemukan.",
    "Searching": "Mencari",
    "Your search did not match any documents. Please make sure that all words are spelled correctly and that you've selected enough categories.": "Tidak ada halaman yang cocok. Periksa ejaan, atau coba kata dasar yang lebih pendek."
  },
  "plural_expr": "0"
});
