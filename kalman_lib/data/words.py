"""What messages about recordings call things, and the notes that a Recording carries."""

NAMES = {  # kind of signal -> its name (en, id)
    "gyr": ("gyroscope", "giroskop"),
    "acc": ("accelerometer", "akselerometer"),
    "linear": ("accelerometer without gravity", "akselerometer tanpa gravitasi"),
    "gravity": ("gravity sensor", "sensor gravitasi"),
    "mag": ("magnetometer", "magnetometer"),
    "orientation": ("orientation", "orientasi"),
}
AXES_NAMES = {
    "phone": (
        "those of a phone (x right, y to the top edge, z out of the screen)",
        "sumbu ponsel (x ke kanan, y ke tepi atas, z keluar dari layar)",
    ),
    "flu": ("forward-left-up", "depan-kiri-atas"),
    "frd": ("forward-right-down", "depan-kanan-bawah"),
}


def say(notes, en, id):
    """Add a sentence to the notes of a recording."""
    notes.append({"en": en, "id": id})
