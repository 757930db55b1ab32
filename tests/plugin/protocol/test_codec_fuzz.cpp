// Mutated messages through the decoder. Build with LAMPBLACK_SANITIZE for this to see what it may.
#include "mutator.h"
#include "protocol/header.h"

#include <QtTest>

#include <memory>
#include <set>
#include <vector>

using namespace lampblack;
using namespace lampblack::protocol;

namespace
{

constexpr int Mutants = 20000;

/// The frames in buffers of exactly their length, so that reading beyond one is seen.
class TightFrames
{
public:
    explicit TightFrames(const QVector<QByteArray>& frames)
    {
        for (const QByteArray& frame : frames)
        {
            mBuffers.push_back(std::make_unique<char[]>(static_cast<std::size_t>(frame.size())));
            std::copy(frame.begin(), frame.end(), mBuffers.back().get());
            mBytes.append({mBuffers.back().get(), frame.size()});
        }
    }

    const QVector<Bytes>& bytes() const { return mBytes; }

private:
    std::vector<std::unique_ptr<char[]>> mBuffers;
    QVector<Bytes> mBytes;
};

/// Whether the decoder gave up on a message before it was a JSON object.
bool diedAsText(ErrorCode code)
{
    return code < ErrorCode::UnknownType;
}

} // namespace

class CodecFuzz : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void mutantsAreJudged();
};

void CodecFuzz::mutantsAreJudged()
{
    Mutator mutator(QStringLiteral(LAMPBLACK_VECTORS), 20190);
    std::set<ErrorCode> codes;
    int accepted = 0;
    int pastJson = 0;
    for (int i = 0; i < Mutants; ++i)
    {
        const Case mutant = mutator.next();
        const TightFrames frames(mutant.frames);
        const Decoded decoded = decode(frames.bytes(), mutant.sender);
        if (const auto* refusal = std::get_if<Refusal>(&decoded))
        {
            codes.insert(refusal->code);
            pastJson += diedAsText(refusal->code) ? 0 : 1;
            continue;
        }
        const auto& received = std::get<Received>(decoded);
        for (const PlaneView& plane : received.planes)
        {
            QCOMPARE(toImage(plane).size(), QSize(plane.plane.width, plane.plane.height));
        }
        QVector<QByteArray> again = mutant.frames;
        again[0] = encode(received.message).value();
        const Decoded second = decode(bytesOf(again), mutant.sender);
        QVERIFY(std::holds_alternative<Received>(second));
        QCOMPARE(messageTree(std::get<Received>(second).message), messageTree(received.message));
        ++accepted;
        ++pastJson;
    }
    qInfo("%d of %d mutants got past JSON, %d were accepted", pastJson, Mutants, accepted);
    QVERIFY(pastJson > Mutants / 2);
    QVERIFY(accepted > Mutants / 10);
    QVERIFY(codes.size() >= 15); // a mutator that reaches few stages proves little
}

QTEST_GUILESS_MAIN(CodecFuzz)
#include "test_codec_fuzz.moc"
