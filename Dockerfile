# docker build -t stdc-slam .    then    docker run --rm -v DATA:/data stdc-slam run /data/SEQUENCE --output /data/results
FROM debian:bookworm-slim AS build
WORKDIR /source
COPY scripts/install-packages scripts/packages.txt scripts/
RUN scripts/install-packages && apt-get install -y -qq --no-install-recommends patchelf zstd >/dev/null
COPY . .
RUN cmake -S . -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release \
      -DSTDC_BUILD_TESTS=OFF -DSTDC_BUILD_SIMULATION=OFF -DSTDC_BUILD_BENCHMARKS=OFF -DSTDC_BUILD_TOOLS=OFF \
 && cmake --build /build \
 && packaging/make_tarball /build /tmp \
 && mkdir /image && tar -C /image --strip-components=1 --zstd -xf /tmp/stdc-slam-*.tar.zst

# The libraries that the program needs come along: Debian's package of OpenCV's core would bring Mesa and LLVM, 200 MB.
FROM debian:bookworm-slim
COPY --from=build /image /usr/local
RUN useradd --create-home slam
USER slam
WORKDIR /data
ENTRYPOINT ["stdc-slam"]
CMD ["--help"]
