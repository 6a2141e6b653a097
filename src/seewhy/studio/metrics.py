"""What the server did, for whoever watches it: counts and times in Prometheus' text."""

from __future__ import annotations

from prometheus_client import CollectorRegistry, Counter, Histogram, generate_latest

__all__ = ["Metrics"]


class Metrics:
    """Requests of one server process.

    Examples
    --------
    >>> metrics = Metrics()
    >>> metrics.note("/ask", 200, 0.03)
    >>> b'seewhy_requests_total{path="/ask",status="200"} 1.0' in metrics.text()
    True
    """

    def __init__(self) -> None:
        self._registry = CollectorRegistry()
        self._requests = Counter(
            "seewhy_requests", "Requests answered.", ("path", "status"), registry=self._registry
        )
        self._seconds = Histogram(
            "seewhy_request_seconds", "Time of a request.", ("path",), registry=self._registry
        )

    def note(self, path: str, status: int, seconds: float) -> None:
        """Count a request."""
        self._requests.labels(path, str(status)).inc()
        self._seconds.labels(path).observe(seconds)

    def text(self) -> bytes:
        """Return all of it."""
        return generate_latest(self._registry)
