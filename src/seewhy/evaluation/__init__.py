"""How well an agent does on annotated pictures: classes, answers, features, axioms, and advice."""

from seewhy.evaluation.answers import EXPLANATORY, score_answer
from seewhy.evaluation.axioms import AxiomRecord, axiom_outcomes, axiom_records
from seewhy.evaluation.judging import evaluate
from seewhy.evaluation.recognition import Recognition
from seewhy.evaluation.result import Evaluation
from seewhy.evaluation.wrong import Misreading, WrongPicture

__all__ = [
    "EXPLANATORY",
    "AxiomRecord",
    "Evaluation",
    "Misreading",
    "Recognition",
    "WrongPicture",
    "axiom_outcomes",
    "axiom_records",
    "evaluate",
    "score_answer",
]
