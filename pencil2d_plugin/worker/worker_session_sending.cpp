// The messages that a session sends to the worker.
#include "worker/worker_session.h"

#include "protocol/planes.h"
#include "worker/frame_list.h"

namespace lampblack
{

namespace
{
constexpr int MaxListLength = 1024;
}

void WorkerSession::sendMessage(const protocol::Message& message, const QVector<QImage>& planes)
{
    if (mGreeted && !mLink->send({message, planes}))
    {
        source().restart(QStringLiteral("It did not read any more."));
    }
}

void WorkerSession::sendAll()
{
    const QList<int> frames = mFrameStore.frames().keys();
    for (const int frame : frames)
    {
        announceFrame(frame);
    }
    sendScene();
    if (mPreview)
    {
        mPreview->request = 0;
    }
    for (QMap<int, quint64>* requests : questions())
    {
        for (quint64& request : *requests)
        {
            request = 0;
        }
    }
    sendPreviewRequest();
    sendQuestions();
    sendJobs();
}

void WorkerSession::announceFrame(int frame)
{
    const ShownFrame shown = mFrameStore.frames().value(frame);
    sendMessage(protocol::PutFrame{frame, shown.digest, shown.camera, {}, {}});
}

void WorkerSession::sendPixels(int frame, const QByteArray& digest)
{
    const Drawing drawing = mFrameStore.drawing(digest);
    if (drawing.pixels.isNull())
    {
        mNeeded.insert(digest);
        Q_EMIT frameNeeded(frame);
        return;
    }
    mNeeded.remove(digest);
    protocol::PutFrame put = {frame, digest, mFrameStore.frames().value(frame).camera, {}, {}};
    QVector<QImage> planes;
    const auto add = [&put, &planes](protocol::Role role, const QImage& image)
    {
        put.planes.append(protocol::viewOf(role, image).plane);
        planes.append(image);
    };
    add(protocol::Role::Pixels, drawing.pixels);
    for (const DrawnLayer& layer : drawing.layers)
    {
        add(protocol::Role::Layer, layer.pixels);
        put.layers.append(layer.name);
    }
    sendMessage(put, planes);
}

void WorkerSession::sendScene()
{
    if (mScene)
    {
        mSceneRevisions.insert(++mRevision);
        sendMessage(protocol::SetScene{mRevision, *mScene});
    }
}

void WorkerSession::sendPreviewRequest()
{
    const bool lit = mPreview && mPreview->show == Show::Lit;
    if (!mGreeted || !mPreview || !mFrameStore.frames().contains(mPreview->frame) || (lit && !mScene))
    {
        return;
    }
    mPreview->request = ++mRequest;
    const QSize size = mPreview->size;
    if (lit)
    {
        sendMessage(
            protocol::Preview{mRequest, mPreview->frame, mPreview->crop, size.width(), size.height()});
    }
    else
    {
        sendMessage(protocol::View{mRequest, mPreview->frame, mPreview->show, mPreview->crop, size.width(),
                                   size.height()});
    }
}

void WorkerSession::sendQuestions()
{
    const auto send = [this](QMap<int, quint64>& requests, auto makeQuestion)
    {
        for (auto asked = requests.begin(); asked != requests.end(); ++asked)
        {
            if (asked.value() == 0 && mFrameStore.frames().contains(asked.key()))
            {
                asked.value() = ++mRequest;
                sendMessage(makeQuestion(asked.key()));
            }
        }
    };
    if (!mGreeted)
    {
        return;
    }
    send(mPaletteRequests, [this](int frame) { return protocol::GetPalette{mRequest, frame}; });
    if (mTellsOverlaps)
    {
        send(mOverlapRequests, [this](int frame) { return protocol::GetOverlaps{mRequest, frame}; });
    }
    if (mTellsNormals && mScene)
    {
        constexpr int Side = 160; ///< that of the grid of instant shadings
        send(mNormalsRequests, [this](int frame) { return protocol::GetNormals{mRequest, frame, Side}; });
    }
    if (mSketchesRigs && mScene)
    {
        send(mRigRequests,
             [this](int frame) {
                 return protocol::GetRigs{mRequest, frame, mRigSide, true, {}};
             });
    }
}

void WorkerSession::sendJobs()
{
    const QList<quint64> numbers = mJobs.jobs().keys();
    for (const quint64 number : numbers)
    {
        RenderJob& job = mJobs.jobs()[number];
        if (!mGreeted || job.request != 0 || !mFrameStore.isHashed(job.lastPut))
        {
            continue;
        }
        const QString frames = formatFrames(job.frames);
        if (frames.isEmpty() || frames.size() > MaxListLength)
        {
            mJobs.end(number, frames.isEmpty() ? protocol::Outcome::Finished : protocol::Outcome::Failed);
            continue;
        }
        const bool other = job.scene && job.scene != mScene;
        if (other)
        {
            mJobRevisions.insert(++mRevision);
            sendMessage(protocol::SetScene{mRevision, *job.scene});
        }
        job.request = ++mRequest;
        ++job.asked;
        sendMessage(protocol::Render{mRequest, frames, job.output, job.quality, !job.project.isEmpty(),
                                     job.project, job.apart});
        if (other)
        {
            sendScene();
        }
    }
}

void WorkerSession::onFrameHashed(int frame, bool changed)
{
    const QByteArray digest = mFrameStore.frames().value(frame).digest;
    if (mNeeded.contains(digest))
    {
        sendPixels(frame, digest);
    }
    else if (changed)
    {
        announceFrame(frame);
    }
    if (mPreview && mPreview->frame == frame && mPreview->request == 0)
    {
        sendPreviewRequest();
    }
    sendQuestions();
    sendJobs();
    Q_EMIT drawingKnown(frame);
}

} // namespace lampblack
