"""What is wrong with a reader's file, in both languages of the book."""


class InputError(ValueError):
    """What is wrong with the reader's input: one sentence in each language, .en and .id."""

    def __init__(self, en, id):
        super().__init__(f"{en} / {id}")
        self.en = en
        self.id = id
