# SeeWhy from its wheel. Build and run, with your folders beside the one that you are in:
#
#   docker build --tag seewhy .
#   docker run --rm --volume "$PWD:/data" seewhy check my_domain
#
# Where your network has an index of PyTorch's builds without CUDA, the image shrinks by gigabytes:
#   docker build --build-arg PIP_EXTRA_INDEX_URL=... --tag seewhy .
FROM python:3.12-slim AS wheel
WORKDIR /source
RUN pip install --no-cache-dir build==1.6.1
COPY pyproject.toml README.md LICENSE ./
COPY src ./src
RUN python -m build --wheel --outdir /dist .

FROM python:3.12-slim
ARG PIP_EXTRA_INDEX_URL=
COPY constraints.txt /tmp/constraints.txt
COPY --from=wheel /dist /tmp/dist
RUN pip install --no-cache-dir --constraint /tmp/constraints.txt /tmp/dist/*.whl \
    && rm -r /tmp/dist /tmp/constraints.txt \
    && useradd --create-home --uid 1000 seewhy
USER seewhy
WORKDIR /data
ENTRYPOINT ["seewhy"]
CMD ["--help"]
