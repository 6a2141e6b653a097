"""The words of a question, without case, accents and punctuation."""

from __future__ import annotations

import re
import unicodedata

CONTRACTIONS = {
    "what's": "what is", "whats": "what is", "it's": "it is", "isn't": "is not",
    "isnt": "is not", "aren't": "are not", "doesn't": "does not", "doesnt": "does not",
    "don't": "do not", "won't": "will not", "can't": "can not", "cannot": "can not",
    "there's": "there is", "how's": "how is", "why's": "why is", "where's": "where is",
    "who's": "who is", "didn't": "did not", "didnt": "did not", "wasn't": "was not",
    "wasnt": "was not", "weren't": "were not", "wouldn't": "would not", "wouldnt": "would not",
    "couldn't": "could not", "couldnt": "could not", "shouldn't": "should not",
    "mustn't": "must not", "hasn't": "has not", "hasnt": "has not", "haven't": "have not",
    "hadn't": "had not", "dont": "do not", "wont": "will not", "cant": "can not",
    "arent": "are not", "werent": "were not", "that's": "that is", "thats": "that is",
    "i'm": "i am", "i'd": "i would", "you're": "you are", "they're": "they are",
    "it'd": "it would", "it'll": "it will", "i've": "i have", "you've": "you have",
    "let's": "let us", "wheres": "where is", "hows": "how is", "whos": "who is",
    "howmany": "how many", "theres": "there is", "hes": "he is", "shes": "she is", "u": "you",
    "r": "are", "ur": "your", "pls": "please", "plz": "please",
}  # fmt: skip
_WORD = re.compile(r"(?<!\w)-\d+|[\w']+")


def words_of(text: str) -> list[str]:
    """Return the words of a text in lower case, contractions written out.

    Examples
    --------
    >>> words_of("Why isn't Sally's_office OPEN?")
    ['why', 'is', 'not', "sally's", 'office', 'open']
    """
    plain = text.casefold()
    if not plain.isascii():
        plain = unicodedata.normalize("NFKD", text).casefold().replace("’", "'")
        plain = "".join(c for c in plain if not unicodedata.combining(c))
    words: list[str] = []
    for word in _WORD.findall(plain.replace("_", " ")):
        written_out = CONTRACTIONS.get(word)
        if written_out is not None:
            words += written_out.split()
        elif bare := word.strip("'"):
            words.append(bare)
    return words
