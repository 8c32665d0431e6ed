// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/SharedCapsules.h"

#include "optimiser/BorderRuns.h"
#include "optimiser/CapsuleRuns.h"

#include <Eigen/Core>

#include <algorithm>
#include <utility>

namespace cactus
{

namespace
{

void setEnds(Capsule& body, const Eigen::Vector3d* points)
{
  std::copy_n(points[0].data(), 3, body.p0);
  std::copy_n(points[1].data(), 3, body.p1);
}

void setRadii(Capsule& body, const double* radii)
{
  body.r0 = radii[0];
  body.r1 = radii[1];
}

/// Puts some values before the others, and some behind them.
template <typename Value>
void surround(const std::vector<Value>& before, std::vector<Value>& values, const std::vector<Value>& behind)
{
  values.reserve(before.size() + values.size() + behind.size());
  values.insert(values.begin(), before.begin(), before.end());
  values.insert(values.end(), behind.begin(), behind.end());
}

template <typename Value>
void keep(std::vector<Value>& values, const CapsuleRange& range)
{
  values.resize(range.end);
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(range.begin));
}

} // namespace

SharedCapsules::SharedCapsules(const Fibres& fibres, const FibreShares& shares)
  : Shares(shares)
  , Periods(fibres.domain)
  , All(capsulesOf(fibres))
  , Own{ 0, this->All.size() }
  , Given(shares.processes())
  , Taken(shares.processes())
{
  if (this->isShared())
  {
    this->All.places = placesOf(shares.fibreIds());
    for (std::uint32_t& fibre : this->All.fibre)
    {
      fibre += static_cast<std::uint32_t>(shares.ownFibre());
    }
  }
  this->IsTapered = isAnyTapered(this->All, this->Own);
}

void SharedCapsules::take(const Fibres& fibres, std::size_t f)
{
  for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
  {
    Capsule& body = this->All.bodies[this->Own.begin + i - f];
    setEnds(body, &fibres.points[i]);
    setRadii(body, &fibres.radii[i]);
  }
}

void SharedCapsules::takeAll(const Fibres& fibres)
{
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    this->take(fibres, f);
  }
  this->IsTapered = isAnyTapered(this->All, this->Own);
}

OverlapParts SharedCapsules::evaluate(
  const NeighbourList& neighbours, double margin, double tolerance, int threads, std::vector<CapsuleOverlap>& result)
{
  return evaluateOverlap(this->All, this->Own, this->Shares.ownCapsule(), neighbours, { margin, tolerance, this->IsTapered },
    threads, this->Rough, result);
}

void SharedCapsules::findNeighbours(const Fibres& fibres, const std::vector<float>& reach, int threads, NeighbourList& list)
{
  if (!this->isShared() && !this->Periods.isPeriodic())
  {
    cactus::findNeighbours(this->All, reach, threads, list);
    return;
  }
  if (!this->isShared())
  {
    this->dropOthers();
    this->Images = imagesWithin(this->Periods, this->All, reach);
    addImages(this->Images, this->All);
    std::vector<float> allReaches = reach;
    for (const CapsuleImage& image : this->Images)
    {
      allReaches.push_back(reach[image.capsule]);
    }
    cactus::findNeighbours(this->All, this->Own, allReaches, threads, list);
    return;
  }
  this->dropOthers();
  const std::vector<float> allReaches = this->giveAway(fibres, this->stretchesNearOthers(reach, threads), reach);
  cactus::findNeighbours(this->All, this->Own, allReaches, threads, list);
}

/// Keeps only the process's own capsules.
void SharedCapsules::dropOthers()
{
  keep(this->All.bodies, this->Own);
  keep(this->All.first, this->Own);
  keep(this->All.fibre, this->Own);
  for (std::uint32_t& first : this->All.first)
  {
    first -= static_cast<std::uint32_t>(this->PointsBefore);
  }
  this->Own = { 0, this->Own.size() };
  this->PointsBefore = 0;
}

/// Returns the capsules that the other processes need for a search. Precondition: only the own capsules are here.
std::vector<std::vector<SharedCapsules::Stretch>> SharedCapsules::stretchesNearOthers(
  const std::vector<float>& reach, int threads) const
{
  const CapsuleRuns runs(this->All, reach, threads);
  const auto near = boxesNearOthers(runs.boxes(), this->Shares.sharing());
  std::vector<std::vector<Stretch>> stretches(near.size());
  for (std::size_t process = 0; process < near.size(); ++process)
  {
    for (const std::size_t run : near[process])
    {
      const std::size_t begin = runs.first()[run];
      const std::size_t count = runs.first()[run + 1] - begin;
      std::vector<Stretch>& all = stretches[process];
      const bool follows =
        !all.empty() && all.back().begin + all.back().count == begin && this->All.first[begin] == this->All.first[begin - 1] + 1;
      if (follows)
      {
        all.back().count += count;
      }
      else
      {
        all.push_back({ begin, count });
      }
    }
  }
  return stretches;
}

/// Writes the control points of stretches and, if asked, their radii.
void SharedCapsules::putPoints(const Fibres& fibres, const std::vector<Stretch>& stretches, bool withRadii, ByteWriter& put) const
{
  for (const Stretch& stretch : stretches)
  {
    const std::size_t first = this->pointOf(stretch.begin);
    put.addAll(&fibres.points[first], stretch.count + 1);
    if (withRadii)
    {
      put.addAll(&fibres.radii[first], stretch.count + 1);
    }
  }
}

void SharedCapsules::getPoints(const std::vector<Stretch>& stretches, bool withRadii, ByteReader& get)
{
  std::vector<Eigen::Vector3d> points;
  std::vector<double> radii;
  for (const Stretch& stretch : stretches)
  {
    points.resize(stretch.count + 1);
    radii.resize(stretch.count + 1);
    get.getAll(points.data(), points.size());
    if (withRadii)
    {
      get.getAll(radii.data(), radii.size());
    }
    for (std::size_t l = 0; l < stretch.count; ++l)
    {
      Capsule& body = this->All.bodies[stretch.begin + l];
      setEnds(body, &points[l]);
      if (withRadii)
      {
        setRadii(body, &radii[l]);
      }
    }
  }
}

/// Sends each process its stretches and receives those of the others. Returns the reaches of all(). Precondition: only the own
/// capsules are here.
std::vector<float> SharedCapsules::giveAway(
  const Fibres& fibres, std::vector<std::vector<Stretch>> stretches, const std::vector<float>& reach)
{
  std::vector<std::string> toEach;
  for (const std::vector<Stretch>& given : stretches)
  {
    ByteWriter put;
    put(static_cast<std::uint8_t>(this->IsTapered));
    put(static_cast<std::uint64_t>(given.size()));
    for (const Stretch& stretch : given)
    {
      put(this->All.fibre[stretch.begin]);
      put(static_cast<std::uint32_t>(stretch.count));
    }
    for (const Stretch& stretch : given)
    {
      put.addAll(&reach[stretch.begin], stretch.count);
    }
    this->putPoints(fibres, given, true, put);
    toEach.push_back(std::move(put.bytes()));
  }
  this->Given = std::move(stretches);
  return this->takeIn(this->Shares.sharing().deal(std::move(toEach)), fibres.points.size(), reach);
}

/// Inserts the received capsules.
std::vector<float> SharedCapsules::takeIn(
  const std::vector<std::string>& found, std::size_t ownPoints, const std::vector<float>& reach)
{
  const auto self = static_cast<std::size_t>(this->Shares.place());
  std::vector<ByteReader> given(found.begin(), found.end());
  Others before;
  this->readStretches({ 0, self }, given, before, 0, 0);
  this->PointsBefore = before.points;
  Others behind;
  this->readStretches({ self + 1, found.size() }, given, behind, before.first.size() + this->Own.size(),
    static_cast<std::uint32_t>(before.points + ownPoints));

  for (std::uint32_t& first : this->All.first)
  {
    first += static_cast<std::uint32_t>(this->PointsBefore);
  }
  const std::size_t count = before.first.size() + this->Own.size() + behind.first.size();
  this->All.bodies.reserve(count); // no more: capsules are most of a process's memory apart from neighbours
  this->All.bodies.insert(this->All.bodies.begin(), before.first.size(), Capsule{});
  this->All.bodies.resize(count);
  surround(before.first, this->All.first, behind.first);
  surround(before.fibre, this->All.fibre, behind.fibre);
  this->Own = { before.first.size(), before.first.size() + this->Own.size() };
  std::vector<float> reaches = reach;
  surround(before.reaches, reaches, behind.reaches);
  for (std::size_t process = 0; process < given.size(); ++process)
  {
    if (process != self)
    {
      this->getPoints(this->Taken[process], true, given[process]);
    }
  }
  this->IsTapered = this->IsTapered || before.isTapered || behind.isTapered;
  return reaches;
}

/// Reads the received capsules of some processes without their control points. The first of these capsules will be the `place`-th
/// of all(), and its first control point the `point`-th.
void SharedCapsules::readStretches(
  const CapsuleRange& processes, std::vector<ByteReader>& given, Others& others, std::size_t place, std::uint32_t point)
{
  const std::uint32_t firstPoint = point;
  for (std::size_t process = processes.begin; process < processes.end; ++process)
  {
    ByteReader& get = given[process];
    others.isTapered = get.get<std::uint8_t>() != 0 || others.isTapered;
    std::vector<Stretch>& taken = this->Taken[process];
    taken.resize(get.get<std::uint64_t>());
    for (Stretch& stretch : taken)
    {
      const auto fibre = get.get<std::uint32_t>();
      stretch = { place + others.first.size(), get.get<std::uint32_t>() };
      for (std::uint32_t l = 0; l < stretch.count; ++l)
      {
        others.fibre.push_back(fibre);
        others.first.push_back(point++);
      }
      ++point; // the last control point begins no capsule
    }
    const std::size_t known = others.reaches.size();
    others.reaches.resize(others.first.size());
    get.getAll(others.reaches.data() + known, others.reaches.size() - known);
  }
  others.points = point - firstPoint;
}

bool SharedCapsules::update(const Fibres& fibres, bool withRadii, bool flag)
{
  bool isTapered = withRadii ? isAnyTapered(this->All, this->Own) : this->IsTapered;
  if (this->isShared())
  {
    const auto self = static_cast<std::size_t>(this->Shares.place());
    std::vector<std::string> toEach(this->Given.size());
    for (std::size_t process = 0; process < toEach.size(); ++process)
    {
      if (process != self)
      {
        ByteWriter put;
        put(static_cast<std::uint8_t>(flag));
        put(static_cast<std::uint8_t>(isTapered));
        this->putPoints(fibres, this->Given[process], withRadii, put);
        toEach[process] = std::move(put.bytes());
      }
    }
    const std::vector<std::string> found = this->Shares.sharing().deal(std::move(toEach));
    for (std::size_t process = 0; process < found.size(); ++process)
    {
      if (process != self)
      {
        ByteReader get(found[process]);
        flag = get.get<std::uint8_t>() != 0 || flag;
        isTapered = get.get<std::uint8_t>() != 0 || isTapered;
        this->getPoints(this->Taken[process], withRadii, get);
      }
    }
  }
  for (std::size_t i = 0; i < this->Images.size(); ++i)
  {
    placeImage(this->All.bodies[this->Images[i].capsule], this->Images[i].shift, this->All.bodies[this->Own.end + i]);
  }
  this->IsTapered = isTapered;
  return flag;
}

} // namespace cactus
