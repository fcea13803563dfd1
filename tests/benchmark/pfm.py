"""Pictures as the benchmarks read them."""
import numpy as np


def read_pfm(path):
    """Values of a PFM file, its rows from the bottom up: height x width x channels."""
    with open(path, "rb") as file:
        channels = {b"PF": 3, b"Pf": 1}[file.readline().strip()]
        width, height = map(int, file.readline().split())
        little = float(file.readline()) < 0
        values = np.frombuffer(file.read(), "<f4" if little else ">f4")
    return values.reshape(height, width, channels).astype(np.float64)
