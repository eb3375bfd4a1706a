from setuptools import setup

setup(cffi_modules=["face.py:builder"])
