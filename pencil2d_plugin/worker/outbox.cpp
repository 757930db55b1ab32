#include "worker/outbox.h"

namespace lampblack
{

namespace
{

constexpr int MaxUnreplaceable = 1000;

// The key of a frame is its number.
constexpr qint64 SceneKey = -1;
constexpr qint64 PreviewKey = -2;
constexpr qint64 NoKey = -3;

qint64 replacementKey(const protocol::Message& message)
{
    if (const auto* put = std::get_if<protocol::PutFrame>(&message))
    {
        return put->frame;
    }
    if (const auto* drop = std::get_if<protocol::DropFrame>(&message))
    {
        return drop->frame;
    }
    if (std::holds_alternative<protocol::SetScene>(message))
    {
        return SceneKey;
    }
    const bool look =
        std::holds_alternative<protocol::Preview>(message) || std::holds_alternative<protocol::View>(message);
    return look ? PreviewKey : NoKey;
}

bool isBarrier(const protocol::Message& message)
{
    return std::holds_alternative<protocol::Hello>(message) ||
           std::holds_alternative<protocol::Render>(message);
}

/// `newer` with the planes of `older`, if both show the same drawing: the worker has asked for them.
Outgoing merged(const Outgoing& older, Outgoing newer)
{
    const auto* was = std::get_if<protocol::PutFrame>(&older.message);
    auto* is = std::get_if<protocol::PutFrame>(&newer.message);
    if (was != nullptr && is != nullptr && was->digest == is->digest && newer.planes.isEmpty())
    {
        is->planes = was->planes;
        is->layers = was->layers;
        newer.planes = older.planes;
    }
    return newer;
}

} // namespace

bool Outbox::push(const Outgoing& outgoing)
{
    const qint64 key = replacementKey(outgoing.message);
    const auto found = mReplaceable.constFind(key);
    if (found != mReplaceable.constEnd())
    {
        const Place place = found.value();
        if (key != PreviewKey)
        {
            place->outgoing = merged(place->outgoing, outgoing);
            return true;
        }
        mWaiting.erase(place); // request numbers must rise, so the new one goes to the end
    }
    if (key == NoKey)
    {
        if (mUnreplaceable >= MaxUnreplaceable)
        {
            return false;
        }
        ++mUnreplaceable;
        if (isBarrier(outgoing.message))
        {
            mReplaceable.clear();
        }
    }
    mWaiting.push_back({outgoing, key});
    if (key != NoKey)
    {
        mReplaceable.insert(key, std::prev(mWaiting.end()));
    }
    return true;
}

Outgoing Outbox::takeFirst()
{
    const Place first = mWaiting.begin();
    const auto found = mReplaceable.constFind(first->key);
    if (first->key == NoKey)
    {
        --mUnreplaceable;
    }
    else if (found != mReplaceable.constEnd() && found.value() == first)
    {
        mReplaceable.erase(found);
    }
    Outgoing outgoing = std::move(first->outgoing);
    mWaiting.erase(first);
    return outgoing;
}

} // namespace lampblack
