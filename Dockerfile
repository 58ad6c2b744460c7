# The service alone. The image has no compiler; the service does not run as root, and writes only to /tmp and /data.
#   docker build -t bench-dragon . && docker run --read-only --tmpfs /tmp -v dragon:/data -p 127.0.0.1:8000:8000 bench-dragon
# Another base, or a newer digest of this one: see docs/operations.md.
FROM python:3.13-slim-trixie@sha256:9d2e5553305c7c7b0097999bb17187c69b921ccd6bc9d40e4bb5ebe652c00285 AS base

FROM base AS build
# Extras of the distribution to install: service,dask adds sweeps on a Dask cluster.
ARG EXTRAS=service
# python3-dev: the headers for an image with Debian's own Python; the official images have theirs.
RUN apt-get update \
    && apt-get install -y --no-install-recommends gcc libc6-dev python3-dev \
    && rm -rf /var/lib/apt/lists/*
RUN python -m venv /opt/bench-dragon
COPY requirements.hashes requirements.lock requirements-test.lock bench_dragon.py pyproject.toml setup.py README.md \
     LICENSE /src/
COPY core /src/core
COPY app /src/app
# What the service needs, and what compiles it, by the digests of the files; other extras by version alone.
RUN /opt/bench-dragon/bin/pip install --no-cache-dir --disable-pip-version-check --require-hashes --no-deps \
        -r /src/requirements.hashes \
    && /opt/bench-dragon/bin/pip install --no-cache-dir --disable-pip-version-check --no-build-isolation \
        -c /src/requirements.lock -c /src/requirements-test.lock "/src[${EXTRAS}]" \
    && /opt/bench-dragon/bin/python -c "import core.kernels; assert core.kernels.COMPILED"
# The guide, which the service shows at /guide/.
COPY *.md requirements-docs.lock /src/
COPY docs /src/docs
RUN python -m venv /opt/docs \
    && /opt/docs/bin/pip install --no-cache-dir --disable-pip-version-check -r /src/requirements-docs.lock \
        -c /src/requirements-test.lock python-flint \
    && place=$(cd /tmp && /opt/bench-dragon/bin/python -c "import app; print(*app.__path__)") \
    && cd /src/docs && PYTHONPATH=$(dirname "$place") /opt/docs/bin/python site/build.py "$place/guide"
# What the service never reads: pip and what compiles, IPython (for plots of uplot-python in notebooks), tests, sources
# and symbols of compiled modules, and the parts of pyarrow that talk to other servers.
RUN cd /opt/bench-dragon/lib/python3*/site-packages \
    && /opt/bench-dragon/bin/python -m pip uninstall -y --quiet babel cython setuptools uv pip ipython ipython-pygments-lexers \
        asttokens executing jedi matplotlib-inline parso pexpect prompt_toolkit ptyprocess pure-eval stack-data traitlets \
        wcwidth \
    && rm -rf pyarrow/include pyarrow/*flight* pyarrow/*s3* pyarrow/*gcsfs* pyarrow/*azurefs* pyarrow/*hdfs* \
        pyarrow/*orc* pyarrow/*feather* pyarrow/libarrow_python*.so pyarrow/*.1.0 \
    && find . -type f \( -name '*.cpython-*.so' -o -name '*.abi3.so' -o -path './pyarrow/lib*.so*' \) \
        -exec strip --strip-unneeded {} + \
    && find . ! -path './core/*' \( -name '*.[ch]' -o -name '*.pyx' -o -name '*.pxi' \) -delete \
    && find . -depth -type d \( -name tests -o -name __pycache__ \) -exec rm -r {} +

FROM base
# A font with Chinese characters, for figures and films in Chinese.
RUN apt-get update \
    && apt-get install -y --no-install-recommends fonts-wqy-microhei \
    && rm -rf /var/lib/apt/lists/* /var/cache/apt/*
COPY --from=build /opt/bench-dragon /opt/bench-dragon
RUN install -d -o 10001 -g 10001 -m 700 /data
VOLUME /data
ENV PATH=/opt/bench-dragon/bin:$PATH \
    BENCH_DRAGON_DATA=/data \
    HOME=/tmp \
    MPLCONFIGDIR=/tmp/matplotlib \
    PYTHONDONTWRITEBYTECODE=1 \
    PYTHONUNBUFFERED=1
USER 10001:10001
WORKDIR /tmp
EXPOSE 8000
HEALTHCHECK --interval=30s --timeout=5s --start-period=20s \
    CMD ["python", "-c", "from urllib.request import *; build_opener(ProxyHandler({})).open('http://127.0.0.1:8000/healthz', timeout=4)"]
CMD ["bench-dragon", "serve", "--host", "0.0.0.0", "--port", "8000", "--workers", "1"]
