#include "worker/inbox.h"

#include <algorithm>

namespace lampblack
{

namespace
{

bool replaces(const protocol::Message& newer, const protocol::Message& older)
{
    if (newer.index() != older.index())
    {
        return false;
    }
    if (const auto* progress = std::get_if<protocol::Progress>(&newer))
    {
        return progress->request == std::get<protocol::Progress>(older).request;
    }
    return std::holds_alternative<protocol::Image>(newer) || std::holds_alternative<protocol::Status>(newer);
}

} // namespace

void Inbox::push(const Incoming& incoming)
{
    const auto isReplaced = [&incoming](const Incoming& older)
    {
        return replaces(incoming.message, older.message);
    };
    mWaiting.erase(std::remove_if(mWaiting.begin(), mWaiting.end(), isReplaced), mWaiting.end());
    mWaiting.append(incoming);
}

QVector<Incoming> Inbox::takeAll()
{
    QVector<Incoming> taken;
    taken.swap(mWaiting);
    return taken;
}

} // namespace lampblack
